// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/StereoMatching.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
/// Calls visit(pixel, sum, number of pixels) with the sum over each pixel's square.
template <typename Visitor>
void forEachBox(const std::vector<double>& values, int width, int height, int window, Visitor&& visit)
{
  // Sums of all that is above and left of a corner.
  const int stride = width + 1;
  std::vector<double> sums(static_cast<std::size_t>(stride) * (height + 1), 0.0);
  for (int row = 0; row < height; ++row)
  {
    double line = 0.0;
    for (int column = 0; column < width; ++column)
    {
      line += values[static_cast<std::size_t>(row) * width + column];
      const std::size_t corner = static_cast<std::size_t>(row + 1) * stride + column + 1;
      sums[corner] = sums[corner - stride] + line;
    }
  }
  for (int row = 0; row < height; ++row)
  {
    const int down = std::min({ window / 2, row, height - 1 - row });
    for (int column = 0; column < width; ++column)
    {
      const int right = std::min({ window / 2, column, width - 1 - column });
      const std::size_t top = static_cast<std::size_t>(row - down) * stride + column;
      const std::size_t bottom = static_cast<std::size_t>(row + down + 1) * stride + column;
      visit(static_cast<std::size_t>(row) * width + column,
        sums[bottom + right + 1] - sums[bottom - right] - sums[top + right + 1] + sums[top - right],
        (2 * down + 1) * (2 * right + 1));
    }
  }
}
}

std::vector<double> boxMeans(const std::vector<double>& values, int width, int height, int window)
{
  std::vector<double> means(values.size());
  forEachBox(
    values, width, height, window, [&](std::size_t pixel, double sum, int pixels) { means[pixel] = sum / pixels; });
  return means;
}

std::vector<double> correlated(const std::vector<double>& noise, int width, int height, int window)
{
  std::vector<double> result(noise.size());
  forEachBox(noise, width, height, window,
    [&](std::size_t pixel, double sum, int pixels) { result[pixel] = sum / std::sqrt(static_cast<double>(pixels)); });
  return result;
}

std::vector<bool> halfOccluded(const std::vector<double>& disparities, int width)
{
  std::vector<bool> hidden(disparities.size(), false);
  double covered = 0.0; // all columns of the second image from here on
  for (std::size_t i = disparities.size(); i-- > 0;)
  {
    const int column = static_cast<int>(i % width);
    if (column == width - 1)
    {
      covered = std::numeric_limits<double>::infinity();
    }
    const double place = column - disparities[i];
    hidden[i] = place >= covered;
    covered = std::min(covered, place);
  }
  return hidden;
}
}
