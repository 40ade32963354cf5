// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

#include <vector>

namespace meam
{
/// Where a part's smooth surface turns away from the sensor. Other than a sharp edge such a contour moves with the
/// view, so it is looked up for each direction: between neighbouring samples the cosine of the normal to the line of
/// sight passes through zero.
class OccludingContours
{
public:
  OccludingContours() = default;
  /// `surface` with normals, `spacing` of its samples in mm.
  OccludingContours(const PointCloud& surface, double spacing);

  /// A point of a contour.
  struct Point
  {
    Eigen::Vector3f point;   ///< mm, where the surface is measured last
    Eigen::Vector3f normal;  ///< unit, across the line of sight
    Eigen::Vector3f tangent; ///< unit, of the contour as the sensor sees it
  };
  /// About one for each spacing of all contours from a direction (unit, to the sensor), seen or hidden by the part.
  /// `inset`: mm across the line of sight from where the surface ends to the last point that a sensor measures there;
  /// on a round one that is nearer by far more.
  std::vector<Point> from(const Eigen::Vector3f& towards, double inset = 0.0) const;

  /// For each edge point whether it is of a contour that some view saw, not of a sharp edge or a border: the surface
  /// about it is smooth, and was seen along it from all views. `views`: bit v: on the edge in view v.
  std::vector<bool> areContours(
    const Points& edges, const std::vector<std::uint32_t>& views, const Points& viewDirections) const;

private:
  Points Samples;
  SoAPoints Normals; ///< of these
  double Spacing = 0.0;
  /// A sample beside which the surface bends away, and the samples there.
  struct Bend
  {
    int sample;
    float mostCosine; ///< of its normal to a line of sight that one of its neighbours turns away from
    int begin, end;   ///< in Neighbours
  };
  std::vector<Bend> Bends;
  std::vector<int> Neighbours;
};
}
