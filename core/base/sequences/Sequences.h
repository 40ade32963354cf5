// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace meam
{
/// of(element) of each. Of Eigen's expressions `of` has to say that it returns a matrix.
template <typename Result, typename Range, typename Of>
std::vector<Result> mapped(const Range& range, const Of& of)
{
  std::vector<Result> results;
  results.reserve(std::size(range));
  for (const auto& element : range)
  {
    results.push_back(of(element));
  }
  return results;
}

/// of(index) of the indices from 0 to `count` - 1.
template <typename Result, typename Of>
std::vector<Result> ofIndices(std::size_t count, const Of& of)
{
  std::vector<Result> results;
  results.reserve(count);
  for (int i = 0; i < static_cast<int>(count); ++i)
  {
    results.push_back(of(i));
  }
  return results;
}

/// The sum of of(element).
template <typename Range, typename Of>
double sumOf(const Range& range, const Of& of)
{
  double sum = 0.0;
  for (const auto& element : range)
  {
    sum += of(element);
  }
  return sum;
}

/// Those of the indices from 0 to `count` - 1 for which isOne(index) holds, in their order.
template <typename IsOne>
std::vector<int> indicesWhere(std::size_t count, const IsOne& isOne)
{
  std::vector<int> indices;
  for (int i = 0; i < static_cast<int>(count); ++i)
  {
    if (isOne(i))
    {
      indices.push_back(i);
    }
  }
  return indices;
}

/// Removes the elements for which isGone(element) holds.
template <typename Element, typename IsGone>
void eraseIf(std::vector<Element>& elements, const IsGone& isGone)
{
  elements.erase(std::remove_if(elements.begin(), elements.end(), isGone), elements.end());
}
}
