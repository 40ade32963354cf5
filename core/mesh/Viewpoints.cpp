// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Viewpoints.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double BorderOfCone = 1e-6; // a direction on the cone's border, to within rounding, is inside

/// Axes first, +z before all, then corners, then edge middles of a cube.
Points cubeDirections()
{
  Points directions;
  for (const int axis : { 2, 0, 1 })
  {
    directions.push_back(Eigen::Vector3f::Unit(axis));
    directions.push_back(-Eigen::Vector3f::Unit(axis));
  }
  for (int nonZero = 3; nonZero >= 2; --nonZero)
  {
    for (int code = 26; code >= 0; --code)
    {
      const Eigen::Vector3i corner(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
      const Eigen::Vector3f direction = corner.cast<float>();
      if (direction.cwiseAbs().sum() == static_cast<float>(nonZero))
      {
        directions.push_back(direction.normalized());
      }
    }
  }
  return directions;
}
}

Points viewDirections(int count, const Eigen::Vector3d& coneDirection, double coneAngle)
{
  if (count < 1)
  {
    throw Error("The number of viewpoints is " + std::to_string(count) + ": it must be at least 1.");
  }
  if (!coneDirection.allFinite() || !(coneDirection.norm() > 0.0))
  {
    throw Error("The direction of the cone of viewpoints is zero: give the side that the part is seen from.");
  }
  if (!(coneAngle > 0.0 && coneAngle <= 180.0))
  {
    throw Error("The angle of the cone of viewpoints must be above 0 and at most 180 degrees.");
  }
  const Eigen::Vector3d axis = coneDirection.normalized();
  const double least = std::cos(coneAngle * M_PI / 180.0);
  if (count == 1 || count == 2 || count == 6 || count == 14 || count == 26)
  {
    Points directions = cubeDirections();
    directions.resize(count);
    const auto isOutside = [&](const auto& direction)
    { return direction.template cast<double>().dot(axis) < least - BorderOfCone; };
    eraseIf(directions, isOutside);
    if (directions.empty())
    {
      throw Error("None of the " + std::to_string(count) +
                  " viewpoints lies inside the cone: widen its angle, or use "
                  "a number other than 1, 2, 6, 14 and 26, which is spread over the inside of the cone.");
    }
    return directions;
  }
  Points directions;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis);
  const double goldenAngle = M_PI * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count * 0.5 * (1.0 - least);
    const double radius = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(radius * std::cos(goldenAngle * i), radius * std::sin(goldenAngle * i), z);
    directions.push_back((turn * direction).cast<float>());
  }
  return directions;
}
}
