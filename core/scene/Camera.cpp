// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Camera.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
/// A ray x/z, y/z after the lens, and how it moves with the ray before the lens.
struct Distorted
{
  Eigen::Vector2d ray;
  Eigen::Matrix2d derivative;
};

/// Brown's model: a radial factor and the tangential terms of a decentred lens. In the rational one the factor is a
/// quotient.
Distorted distort(const std::array<double, 8>& distortion, const Eigen::Vector2d& ray)
{
  const auto [k1, k2, p1, p2, k3, k4, k5, k6] = distortion;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = ray.squaredNorm();
  const double above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double radial = above / below;
  // Of the radial factor over r2.
  const double slope = (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3) - radial * (k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6))) / below;
  Distorted result;
  result.ray = { x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
    y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y };
  const double mixed = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  result.derivative << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed, //
    mixed, radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return result;
}

/// The ray that the lens turns into `seen`, by Newton's method; NaN when there is none near it.
Eigen::Vector2d undistort(const std::array<double, 8>& distortion, const Eigen::Vector2d& seen)
{
  constexpr int mostSteps = 30;    // it takes a few
  constexpr double enough = 1e-12; // of a focal length, what rounding leaves
  Eigen::Vector2d ray = seen;
  for (int step = 0; step < mostSteps; ++step)
  {
    const Distorted now = distort(distortion, ray);
    const Eigen::Vector2d rest = seen - now.ray;
    // The lens folds the image over where the determinant is 0; no sensor's pixel lies there.
    if (!(now.derivative.determinant() > 0.0))
    {
      break;
    }
    if (rest.cwiseAbs().maxCoeff() <= enough)
    {
      return ray;
    }
    ray += now.derivative.inverse() * rest;
  }
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

bool isDistorted(const Camera& camera)
{
  return std::any_of(camera.distortion.begin(), camera.distortion.end(), [](double value) { return value != 0.0; });
}
}

void requireCamera(const Camera& camera)
{
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0) || !finite(camera.fx) || !finite(camera.fy))
  {
    throw Error("The camera's focal lengths fx and fy must be positive numbers, in pixels.");
  }
  if (!finite(camera.cx) || !finite(camera.cy) || !camera.T_camera_scene.matrix().allFinite() ||
      !std::all_of(camera.distortion.begin(), camera.distortion.end(), finite))
  {
    throw Error("The camera's principal point, distortion or position has a value that is not a number.");
  }
  if (camera.width < 0 || camera.height < 0)
  {
    throw Error("The camera's width and height must not be negative; 0 stands for not known.");
  }
}

Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d inCamera = camera.T_camera_scene * point;
  if (!(inCamera.z() > 0.0))
  {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::Vector2d ray = inCamera.head<2>() / inCamera.z();
  if (isDistorted(camera))
  {
    ray = distort(camera.distortion, ray).ray;
  }
  return { camera.fx * ray.x() + camera.cx, camera.fy * ray.y() + camera.cy };
}

Eigen::Vector3d unproject(const Camera& camera, const Eigen::Vector2d& pixel, double depth)
{
  Eigen::Vector2d ray((pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy);
  if (isDistorted(camera))
  {
    ray = undistort(camera.distortion, ray);
  }
  return camera.T_camera_scene.inverse() * Eigen::Vector3d(depth * ray.x(), depth * ray.y(), depth);
}
}
