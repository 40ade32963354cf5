// SPDX-License-Identifier: BSD-3-Clause
#include "model/Viewpoints.h"

#include "Error.h"

#include <cmath>

namespace meam
{
Points viewDirections(int count)
{
  if (count < 1)
  {
    throw Error("The number of viewpoints is " + std::to_string(count) + ": it must be at least 1.");
  }
  Points directions;
  if (count == 1 || count == 2 || count == 6 || count == 14 || count == 26)
  {
    // Axes first, +z before all, then corners, then edge middles.
    for (const int axis : { 2, 0, 1 })
    {
      directions.push_back(Eigen::Vector3f::Unit(axis));
      directions.push_back(-Eigen::Vector3f::Unit(axis));
    }
    for (int nonZero = 3; nonZero >= 2; --nonZero)
    {
      for (int code = 26; code >= 0; --code)
      {
        const Eigen::Vector3f direction(code % 3 - 1.0f, code / 3 % 3 - 1.0f, code / 9 - 1.0f);
        if (direction.cwiseAbs().sum() == static_cast<float>(nonZero))
        {
          directions.push_back(direction.normalized());
        }
      }
    }
    directions.resize(count);
    return directions;
  }
  const double goldenAngle = M_PI * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - z * z);
    directions.push_back(Eigen::Vector3d(radius * std::cos(goldenAngle * i), radius * std::sin(goldenAngle * i), z).cast<float>());
  }
  return directions;
}
}
