// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace meam
{
/// Random numbers that are the same on every platform for the same seed; the distributions of the
/// standard library are not.
class Random
{
public:
  explicit Random(unsigned seed)
    : Engine(seed)
  {
  }

  /// Uniform in (0, 1).
  double uniform() { return (static_cast<double>(this->Engine()) + 0.5) / 4294967296.0; }
  /// Uniform in (low, high).
  double uniform(double low, double high) { return low + (high - low) * this->uniform(); }
  /// Uniform in {0, ..., count - 1}.
  std::size_t index(std::size_t count)
  {
    return static_cast<std::size_t>(this->uniform() * static_cast<double>(count));
  }
  /// Close to normal with mean 0 and variance 1, within [-6, 6]: twelve uniforms, no logarithm.
  double normal()
  {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
    {
      sum += this->uniform();
    }
    return sum;
  }
  template <typename T>
  void shuffle(std::vector<T>& values)
  {
    for (std::size_t i = values.size(); i > 1; --i)
    {
      std::swap(values[i - 1], values[this->index(i)]);
    }
  }

private:
  std::mt19937 Engine;
};
}
