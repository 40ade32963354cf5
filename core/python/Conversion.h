// SPDX-License-Identifier: BSD-3-Clause
/// What the bindings of meam.h and of picks.h share: NumPy's arrays and the interpreter's lock.
#pragma once

#include "meam.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cstring>

namespace meamPython
{
namespace py = pybind11;

/// A row of three for each point, or corner of a triangle; other types of numbers are converted.
template <typename Scalar>
using Triples = py::array_t<Scalar, py::array::c_style | py::array::forcecast>;

template <typename Scalar>
std::vector<Eigen::Matrix<Scalar, 3, 1>> vectorsOf(const Triples<Scalar>& rows)
{
  std::vector<Eigen::Matrix<Scalar, 3, 1>> vectors(static_cast<std::size_t>(rows.size() / 3));
  if (!vectors.empty())
  {
    std::memcpy(vectors.front().data(), rows.data(), 3 * sizeof(Scalar) * vectors.size());
  }
  return vectors;
}

template <typename Scalar>
py::array_t<Scalar> arrayOf(const std::vector<Eigen::Matrix<Scalar, 3, 1>>& vectors)
{
  const py::array::ShapeContainer shape{ static_cast<py::ssize_t>(vectors.size()), py::ssize_t{ 3 } };
  return py::array_t<Scalar>(shape, vectors.empty() ? nullptr : vectors.front().data());
}

/// Calls work(progress) without the interpreter's lock, so that other threads of Python run meanwhile. Every 50 ms it
/// looks at signals: what their handlers raise, as Ctrl-C does, ends the work and comes out.
template <typename Work>
auto withoutLock(const Work& work)
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds interval(50);
  auto next = Clock::now() + interval;
  const py::gil_scoped_release unlocked;
  const meam::Progress progress = [&next, interval](double)
  {
    if (Clock::now() < next)
    {
      return true;
    }
    next = Clock::now() + interval;
    const py::gil_scoped_acquire lock;
    return PyErr_CheckSignals() == 0;
  };
  try
  {
    return work(progress);
  }
  catch (const meam::Aborted&)
  {
    const py::gil_scoped_acquire lock;
    throw py::error_already_set();
  }
}

void bindDetection(py::module_& module);
void bindPicks(py::module_& module);
}
