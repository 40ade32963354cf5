// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairKeys.h"

#include "base/AllVectors.h"

#include <algorithm>

namespace meam
{
namespace
{
/// atan2 in units of a full turn of 2^TurnBits, rounded, in [0, 2^TurnBits).
inline PairTurn turnOf(float sine, float cosine)
{
  const float s = std::abs(sine);
  const float c = std::abs(cosine);
  const float ratio = std::min(s, c) / std::max(std::max(s, c), 1e-30f);
  const float square = ratio * ratio;
  float angle = -0.01172120f; // minimax over [0, 1], within 2e-6
  for (const float coefficient : { 0.05265332f, -0.11643287f, 0.19354346f, -0.33262347f, 0.99997726f })
  {
    angle = angle * square + coefficient;
  }
  angle *= ratio;
  angle = s > c ? static_cast<float>(M_PI_2) - angle : angle;
  angle = cosine < 0.0f ? static_cast<float>(M_PI) - angle : angle;
  angle = sine < 0.0f ? static_cast<float>(2.0 * M_PI) - angle : angle;
  return static_cast<PairTurn>(static_cast<int>(angle * static_cast<float>((1 << TurnBits) / (2.0 * M_PI)) + 0.5f)) &
         TurnMask;
}

/// What one reference is to all of its pairs.
struct Reference
{
  Eigen::Vector3f point, direction, second, third;
};

constexpr int Lanes = BlockedPoints::Size;
constexpr float FarAway = 1e15f; // its square is finite

template <bool OfLines>
[[gnu::always_inline]] inline void computeKeys(const Reference& reference, const SoAPoints& referred,
  const SoAPoints& directions, const int* blocks, int count, const PairFeatureQuantizer& quantizer, int* keys,
  PairTurn* turns)
{
  const float px = reference.point.x(), py = reference.point.y(), pz = reference.point.z();
  const float rx = reference.direction.x(), ry = reference.direction.y(), rz = reference.direction.z();
  const float ux = reference.second.x(), uy = reference.second.y(), uz = reference.second.z();
  const float vx = reference.third.x(), vy = reference.third.y(), vz = reference.third.z();
  const float *x = referred.x.data(), *y = referred.y.data(), *z = referred.z.data();
  const float *directionX = directions.x.data(), *directionY = directions.y.data(), *directionZ = directions.z.data();
  const bool oriented = quantizer.kind() == PairFeatureKind::Oriented;
  const PairFeatureQuantizer cut = quantizer;
  for (int block = 0; block < count; ++block)
  {
    const int begin = blocks[block] * Lanes;
    int* toKeys = keys + block * Lanes;
    PairTurn* toTurns = turns + block * Lanes;
#pragma omp simd
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const int k = begin + lane;
      const float dx = x[k] - px, dy = y[k] - py, dz = z[k] - pz;
      const float tx = directionX[k], ty = directionY[k], tz = directionZ[k];
      const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
      const float inverse = 1.0f / std::max(length, 1e-30f);
      const float alongReference = rx * dx + ry * dy + rz * dz;
      const float alongReferred = tx * dx + ty * dy + tz * dz;
      const float between = rx * tx + ry * ty + rz * tz;
      PairFeature feature;
      feature.distance = length;
      PairTurn against = 0u;
      if constexpr (OfLines)
      {
        feature.referenceAngle = acuteAngle(std::min(std::abs(alongReference) * inverse, 1.0f));
        feature.referredAngle = acuteAngle(std::min(std::abs(alongReferred) * inverse, 1.0f));
        const float sign = (alongReference < 0.0f) != (alongReferred < 0.0f) ? -1.0f : 1.0f;
        const float cosine = oriented ? sign * between : std::abs(between);
        feature.betweenAngle = fullAngle(std::min(std::max(cosine, -1.0f), 1.0f));
        const float determinant = (ry * tz - rz * ty) * dx + (rz * tx - rx * tz) * dy + (rx * ty - ry * tx) * dz;
        feature.rightHanded = sign * determinant > 0.0f;
        against = alongReference < 0.0f ? 1u << TurnBits : 0u;
      }
      else
      {
        feature.referenceAngle = fullAngle(std::min(std::max(alongReference * inverse, -1.0f), 1.0f));
        feature.referredAngle = fullAngle(std::min(std::max(alongReferred * inverse, -1.0f), 1.0f));
        feature.betweenAngle = fullAngle(std::min(std::max(between, -1.0f), 1.0f));
        feature.rightHanded = false;
      }
      toKeys[lane] = length > 0.0f ? cut.key(feature) : -1;
      toTurns[lane] = turnOf(vx * dx + vy * dy + vz * dz, ux * dx + uy * dy + uz * dz) | against;
    }
  }
}

MEAM_ALL_VECTORS
void computeKeysOfTangents(const Reference& reference, const SoAPoints& referred, const SoAPoints& tangents,
  const int* blocks, int count, const PairFeatureQuantizer& quantizer, int* keys, PairTurn* turns)
{
  computeKeys<true>(reference, referred, tangents, blocks, count, quantizer, keys, turns);
}

MEAM_ALL_VECTORS
void computeKeysOfNormals(const Reference& reference, const SoAPoints& referred, const SoAPoints& normals,
  const int* blocks, int count, const PairFeatureQuantizer& quantizer, int* keys, PairTurn* turns)
{
  computeKeys<false>(reference, referred, normals, blocks, count, quantizer, keys, turns);
}
}

PairKeys::PairKeys(const Points& referred, const Points& directions, const PairFeatureQuantizer& quantizer)
  : Quantizer(quantizer)
{
  for (std::size_t i = 0; i < referred.size(); ++i)
  {
    this->Referred.add(referred[i]);
    this->Directions.add(directions[i]);
  }
  while (this->Referred.size() % Lanes != 0)
  {
    this->Referred.add(Eigen::Vector3f::Constant(FarAway));
    this->Directions.add(Eigen::Vector3f::UnitX());
  }
}

void PairKeys::compute(const PairFrame& reference, const int* blocks, int count, int* keys, PairTurn* turns) const
{
  const auto compute = isOfLines(this->Quantizer.kind()) ? computeKeysOfTangents : computeKeysOfNormals;
  compute({ reference.Origin, reference.Axes.col(0), reference.Axes.col(1), reference.Axes.col(2) }, this->Referred,
    this->Directions, blocks, count, this->Quantizer, keys, turns);
}
}
