// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseResiduals.h"

#include "base/AllVectors.h"
#include "pose/refinement/SizeEquations.h"

#include <algorithm>

namespace meam
{
namespace
{
MEAM_ALL_VECTORS
void againstSurface(const SoAOrientedPoints& surface, int first, const DepthMap::Seen& seen,
  const SurfaceWeights& weights, NormalEquations::Rows& rows)
{
  const float *x = &surface.points.x[first], *y = &surface.points.y[first], *z = &surface.points.z[first];
  const float *u = &surface.directions.x[first], *v = &surface.directions.y[first], *w = &surface.directions.z[first];
  const float inverseLimit = 1.0f / (weights.limit * weights.limit);
  const float farthest = weights.farthest * weights.farthest;
  const float least = weights.fadesAtBorders ? 0.0f : 1.0f;
  const int count = rows.count;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float dx = x[k] - seen.x[k], dy = y[k] - seen.y[k], dz = z[k] - seen.z[k];
    const float residual = u[k] * dx + v[k] * dy + w[k] * dz;
    const float near = std::max(0.0f, 1.0f - residual * residual * inverseLimit);
    const bool counts = (seen.inside[k] > 0.0f) & (dx * dx + dy * dy + dz * dz <= farthest);
    rows.x[k] = x[k];
    rows.y[k] = y[k];
    rows.z[k] = z[k];
    rows.directionX[k] = u[k];
    rows.directionY[k] = v[k];
    rows.directionZ[k] = w[k];
    rows.residual[k] = residual;
    rows.weight[k] = counts ? near * near * std::max(seen.inside[k], least) : 0.0f;
  }
}

/// Along both axes across the lines (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
MEAM_ALL_VECTORS
void acrossLines(const SoAOrientedPoints& lines, int first, const SoAPoints& offsets, const float* weights,
  NormalEquations::Rows& along, NormalEquations::Rows& beside)
{
  const float *x = &lines.points.x[first], *y = &lines.points.y[first], *z = &lines.points.z[first];
  const float *u = &lines.directions.x[first], *v = &lines.directions.y[first], *w = &lines.directions.z[first];
  const float *offX = &offsets.x[first], *offY = &offsets.y[first], *offZ = &offsets.z[first];
  const int count = along.count;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float sign = w[k] < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + w[k]);
    const float b = u[k] * v[k] * a;
    const float firstX = 1.0f + sign * u[k] * u[k] * a, firstY = sign * b, firstZ = -sign * u[k];
    const float secondX = b, secondY = sign + v[k] * v[k] * a, secondZ = -v[k];
    along.x[k] = beside.x[k] = x[k];
    along.y[k] = beside.y[k] = y[k];
    along.z[k] = beside.z[k] = z[k];
    along.directionX[k] = firstX;
    along.directionY[k] = firstY;
    along.directionZ[k] = firstZ;
    along.residual[k] = firstX * offX[k] + firstY * offY[k] + firstZ * offZ[k];
    beside.directionX[k] = secondX;
    beside.directionY[k] = secondY;
    beside.directionZ[k] = secondZ;
    beside.residual[k] = secondX * offX[k] + secondY * offY[k] + secondZ * offZ[k];
    along.weight[k] = beside.weight[k] = weights[first + k];
  }
}
}

template <typename Fit>
void addSurfaceResiduals(
  Fit& fit, const DepthMap& depth, const SoAOrientedPoints& surface, const SurfaceWeights& weights)
{
  const int size = static_cast<int>(surface.size());
  DepthMap::Seen seen;
  NormalEquations::Rows rows;
  for (int begin = 0; begin < size; begin += SoABlock)
  {
    rows.count = std::min(SoABlock, size - begin);
    depth.meansAt(surface.points, begin, rows.count, seen);
    againstSurface(surface, begin, seen, weights, rows);
    fit.add(rows);
  }
}

template <typename Fit>
void addLineResiduals(
  Fit& fit, const SoAOrientedPoints& lines, const SoAPoints& offsets, const std::vector<float>& weights)
{
  const int size = static_cast<int>(lines.size());
  NormalEquations::Rows along, beside;
  for (int begin = 0; begin < size; begin += SoABlock)
  {
    along.count = beside.count = std::min(SoABlock, size - begin);
    acrossLines(lines, begin, offsets, weights.data(), along, beside);
    fit.add(along);
    fit.add(beside);
  }
}

template void addSurfaceResiduals(NormalEquations&, const DepthMap&, const SoAOrientedPoints&, const SurfaceWeights&);
template void addSurfaceResiduals(SizeEquations&, const DepthMap&, const SoAOrientedPoints&, const SurfaceWeights&);
template void addLineResiduals(NormalEquations&, const SoAOrientedPoints&, const SoAPoints&, const std::vector<float>&);
template void addLineResiduals(SizeEquations&, const SoAOrientedPoints&, const SoAPoints&, const std::vector<float>&);
}
