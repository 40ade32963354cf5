// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

#include <vector>

namespace meam
{
struct OccludingContoursSettings
{
  double neighbour = 1.6; ///< of the samples' spacing, up to which two are neighbours
  double flattest = 1.0;  ///< degrees between the normals of neighbours: less, and the surface is flat there
  double sharpest = 30.0; ///< degrees; more, and an edge of the part lies between them, which is seen from all sides
  double smooth = 15.0; ///< degrees between the normals about an edge point and their mean: more, and it is of an edge
  double seenLast = 0.12; ///< cosine at which any sensor loses a surface that turns away
  double seenFirst = 0.7; ///< cosine at which it does not, however coarse
  double grazing = 0.25;  ///< cosine: an edge point from whose views its surface is seen flatter was a contour there
};

/// Where a part's smooth surface turns away from the sensor. Other than a sharp edge such a contour moves with the
/// view, so it is looked up for each direction: between neighbouring samples the cosine of the normal to the line of
/// sight passes through zero.
class OccludingContours
{
public:
  OccludingContours() = default;
  /// `surface` with normals, `spacing` of its samples in mm.
  OccludingContours(const PointCloud& surface, double spacing, const OccludingContoursSettings& settings = {});

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
  OccludingContoursSettings Settings;
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
