// SPDX-License-Identifier: BSD-3-Clause
#include "model/MEAMHashing.h"

#include "base/Bounds.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/Range.h"
#include "base/sequences/Sequences.h"
#include "mesh/ConvexHull.h"
#include "mesh/Viewpoints.h"
#include "model/AppearanceModel.h"
#include "model/VisibilityExtraction.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>

namespace meam
{
namespace
{
constexpr double VoxelShare = 0.015;    // of the diameter
constexpr double SameEdgeCosine = 0.94; // of 20 degrees between the tangents of one edge in two views
constexpr double EdgeVoxels = 2.0;      // so near is the surface point of an edge point that does not have its number
constexpr double SurfaceLeafShare = 0.015; // of the diameter: of the surface samples in a cube of this side one stays

constexpr double FacingCosine = 0.1; // of 84 degrees: a point turned farther from a direction faces elsewhere
void collectEdges(
  const std::vector<AppearanceModel>& edgeModels, double mergeDistance, TrainedModel& model, const Progress& progress)
{
  PointCloud& edges = model.edges;
  const float sameEdge = static_cast<float>(SameEdgeCosine);
  const bool haveIds = std::all_of(edgeModels.begin(), edgeModels.end(),
    [](const auto& view) { return view.cloud.pointIds.size() == view.cloud.size(); });
  for (std::size_t view = 0; view < edgeModels.size(); ++view)
  {
    const PointCloud& cloud = edgeModels[view].cloud;
    const std::uint32_t bit = 1u << view;
    const std::size_t known = edges.size(); // points of one view never merge with each other
    if (known + cloud.size() > TrainedModel::MostEdges)
    {
      throw Error("The appearance models have more than 65536 edge points: thin them with a larger leaf size.");
    }
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      if (i % 1024 == 0)
      {
        report(progress, (view + static_cast<double>(i) / cloud.size()) / edgeModels.size());
      }
      int same = -1;
      float nearest = static_cast<float>(mergeDistance * mergeDistance);
      for (std::size_t k = 0; model.settings.merging == ViewMerging::Points && k < known; ++k)
      {
        const float distance = (edges.points[k] - cloud.points[i]).squaredNorm();
        if (distance <= nearest && std::abs(edges.tangents[k].dot(cloud.tangents[i])) > sameEdge)
        {
          nearest = distance;
          same = static_cast<int>(k);
        }
      }
      if (same >= 0)
      {
        model.edgeViews[same] |= bit;
        continue;
      }
      edges.points.push_back(cloud.points[i]);
      edges.tangents.push_back(cloud.tangents[i]);
      if (haveIds)
      {
        edges.pointIds.push_back(cloud.pointIds[i]);
      }
      model.edgeViews.push_back(bit);
    }
  }
}

/// For each surface point the directions it is visible from, as bits.
std::vector<std::uint32_t> visibilityBits(const Points& surface, int directions, const Progress& progress)
{
  std::vector<std::uint32_t> bits(surface.size(), 0);
  if (directions == 0 || surface.empty())
  {
    return bits;
  }
  const Points towards = viewDirections(directions);
  const VisibilityExtractionSettings settings;
  const Eigen::Vector3d middle = bounds(surface).center().cast<double>();
  const double distance = settings.viewpointDistance * diameter(surface);
  std::vector<std::vector<int>> visible(directions);
  parallelForEach(directions, 0, progress,
    [&](int c)
    { visible[c] = visiblePoints(surface, middle + distance * towards[c].cast<double>(), settings.radiusFactor); });
  for (int c = 0; c < directions; ++c)
  {
    for (const int i : visible[c])
    {
      bits[i] |= 1u << c;
    }
  }
  return bits;
}

/// Bits of the surface point that each edge point is, by its id or by place.
std::vector<std::uint32_t> edgeVisibility(
  const PointCloud& edges, const PointCloud& surface, const std::vector<std::uint32_t>& surfaceBits, double reach)
{
  std::vector<std::uint32_t> bits(edges.size(), 0);
  if (surface.empty())
  {
    return bits;
  }
  const PointGrid grid(surface.points, reach);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (!edges.pointIds.empty() && edges.pointIds[i] >= 0 && edges.pointIds[i] < static_cast<int>(surface.size()))
    {
      bits[i] = surfaceBits[edges.pointIds[i]];
      continue;
    }
    float nearest = INFINITY;
    grid.forEachWithin(edges.points[i], reach,
      [&](int index, float distance)
      {
        if (distance < nearest)
        {
          nearest = distance;
          bits[i] = surfaceBits[index];
        }
      });
  }
  return bits;
}

/// Equation (2): the number of each edge point's voxel, counted from 0.
std::vector<int> voxelNumbers(const Points& points, double voxelSize)
{
  const Eigen::Vector3f low = bounds(points).min();
  std::unordered_map<std::uint64_t, int> numberOf;
  std::vector<int> numbers;
  numbers.reserve(points.size());
  for (const auto& point : points)
  {
    // The minimum is subtracted before the cast, so no voxel is twice as wide as the others.
    const Eigen::Array3d index = ((point - low).cast<double>() / voxelSize).array().floor();
    const std::uint64_t code = (static_cast<std::uint64_t>(index.x()) << 42) |
                               (static_cast<std::uint64_t>(index.y()) << 21) | static_cast<std::uint64_t>(index.z());
    numbers.push_back(numberOf.try_emplace(code, static_cast<int>(numberOf.size())).first->second);
  }
  return numbers;
}

/// Takes one edge point of each cube to the front; returns how many these are.
int bringVotersForward(TrainedModel& model)
{
  std::vector<int> order = thinPoints(model.edges.points, model.votingLeaf());
  const int voters = static_cast<int>(order.size());
  std::vector<bool> votes(model.edges.size(), false);
  for (const int i : order)
  {
    votes[i] = true;
  }
  for (int i = 0; i < static_cast<int>(votes.size()); ++i)
  {
    if (!votes[i])
    {
      order.push_back(i);
    }
  }
  model.edges = model.edges.subset(order);
  model.edgeViews = mapped<std::uint32_t>(order, [&](const int i) { return model.edgeViews[i]; });
  return voters;
}

void requireRoom(std::size_t entries, const char* what, const char* leaf)
{
  constexpr std::size_t most = 50000000; // 2 GB while the table is made
  if (entries > most)
  {
    throw Error("The pair table would have more than 50 million entries: thin the " + std::string(what) +
                " points with a larger " + leaf + ".");
  }
}

/// Finds the pairs of edge points that the table holds.
class EdgePairs
{
public:
  /// Of the first `count` edge points.
  EdgePairs(const TrainedModel& model, int count, double voxelSize)
    : Model(model)
    , Quantizer(model.quantizer())
    , Count(count)
    , ByReference(count)
    , IsReference(representatives(model.edges.points, model.symmetries, voxelSize))
  {
    if (model.settings.merging == ViewMerging::VoxelCodes)
    {
      this->Voxels = voxelNumbers(model.edges.points, voxelSize);
    }
  }

  /// Of all references, in their order.
  std::vector<PairEntry> find(const Progress& progress)
  {
    // Pairs from one voxel to another are one; those from different voxels have nothing to do with each other.
    std::vector<std::vector<int>> groups;
    for (int reference = 0; reference < this->Count; ++reference)
    {
      const std::size_t group = this->Voxels.empty() ? reference : this->Voxels[reference];
      groups.resize(std::max(groups.size(), group + 1));
      groups[group].push_back(reference);
    }
    parallelFor(static_cast<int>(groups.size()), 0, progress,
      [&](int begin, int end, int thread)
      {
        for (int group = begin; group < end; ++group)
        {
          const double share = static_cast<double>(group) / static_cast<double>(groups.size());
          this->findFrom(groups[group], thread == 0 ? subProgress(progress, share, share) : Progress());
        }
      });
    std::vector<PairEntry> all;
    all.reserve(this->Found);
    for (std::vector<PairEntry>& some : this->ByReference)
    {
      all.insert(all.end(), some.begin(), some.end());
      std::vector<PairEntry>().swap(some);
    }
    return all;
  }

private:
  /// Of the references in one voxel, of which there may be all: the progress is asked whether to go on.
  void findFrom(const std::vector<int>& references, const Progress& progress)
  {
    constexpr std::size_t between = 64; // references between two reports
    const PointCloud& edges = this->Model.edges;
    std::vector<std::pair<int, int>> known(this->Voxels.size(), { -1, 0 }); // to a voxel: reference, and its entry
    for (std::size_t k = 0; k < references.size(); ++k)
    {
      if (k % between == between - 1)
      {
        report(progress, 0.0);
      }
      const int r = references[k];
      const PairFrame frame(edges.points[r], edges.tangents[r]);
      std::vector<PairEntry>& entries = this->ByReference[r];
      for (int i = 0; i < this->Count && this->IsReference[r]; ++i)
      {
        const std::uint32_t views = this->Model.edgeViews[r] & this->Model.edgeViews[i];
        if (i == r || !(views != 0 || this->areVisibleTogether(r, i)))
        {
          continue;
        }
        const PairFeature feature =
          pairFeature(this->Quantizer.kind(), edges.points[r], edges.tangents[r], edges.points[i], edges.tangents[i]);
        const int key = this->Quantizer.key(feature);
        if (key < 0 || !(feature.distance > 0.0f))
        {
          continue;
        }
        if (!this->Voxels.empty() && views != 0)
        {
          // The same physical pair in another view: saved once, seen in both.
          auto& [reference, entry] = known[this->Voxels[i]];
          if (reference < 0)
          {
            reference = r;
            entry = static_cast<int>(entries.size());
          }
          else if ((this->ByReference[reference][entry].viewBits & views) == 0)
          {
            this->ByReference[reference][entry].viewBits |= views;
            continue;
          }
        }
        entries.push_back({ static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(r),
          static_cast<std::uint32_t>(i), frame.angleOf(edges.points[i]), views });
      }
      requireRoom(this->Found += entries.size(), "edge", "leaf size");
    }
  }

  bool areVisibleTogether(int a, int b) const
  {
    return this->Model.settings.merging != ViewMerging::None &&
           (this->Model.edgeVisible[a] & this->Model.edgeVisible[b]) != 0;
  }

  const TrainedModel& Model;
  PairFeatureQuantizer Quantizer;
  int Count;
  std::vector<std::vector<PairEntry>> ByReference;
  std::vector<bool> IsReference;
  std::vector<int> Voxels; ///< of the edge points, when pairs of several views are merged by them
  std::atomic<std::size_t> Found{ 0 };
};

/// Of the directions that show a surface point those that it faces: hidden point removal lets some of the back through.
std::uint32_t facedOf(std::uint32_t visible, const Eigen::Vector3f& normal, const Points& towards, float facingCosine)
{
  for (std::size_t c = 0; c < towards.size(); ++c)
  {
    visible &= normal.dot(towards[c]) > facingCosine ? ~0u : ~(1u << c);
  }
  return visible;
}

/// Of the pairs of surface points, one in each cube, that are visible together from a direction. `visible`: bits of
/// these directions; without directions all pairs are (Drost et al. [12]).
void buildSurfaceTable(TrainedModel& model, const PointCloud& surface, const std::vector<std::uint32_t>& visible,
  double voxelSize, const Progress& progress)
{
  const bool haveDirections = model.settings.coVisibilityDirections > 0;
  const Points towards = haveDirections ? viewDirections(model.settings.coVisibilityDirections) : Points();
  const float facingCosine = static_cast<float>(FacingCosine);
  std::vector<int> seen;
  std::vector<std::uint32_t> faced; // of these
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    const std::uint32_t bits = facedOf(visible[i], surface.normals[i], towards, facingCosine);
    if (!haveDirections || bits != 0)
    {
      seen.push_back(static_cast<int>(i));
      faced.push_back(bits);
    }
  }
  PointCloud& points = model.surfacePairPoints;
  std::vector<std::uint32_t> views;
  const PointCloud candidates = surface.subset(seen);
  for (const int k : thinSamples(candidates, model.settings.surface.leafSize * model.diameter, model.diameter))
  {
    points.points.push_back(surface.points[seen[k]]);
    points.normals.push_back(surface.normals[seen[k]]);
    views.push_back(faced[k]);
  }
  const PairFeatureQuantizer quantizer = model.surfaceQuantizer();
  const std::vector<bool> isReference = representatives(points.points, model.symmetries, voxelSize);
  const int count = static_cast<int>(points.size());
  std::vector<PairEntry> entries;
  for (int r = 0; r < count; ++r)
  {
    if (r % 64 == 0)
    {
      report(progress, static_cast<double>(r) / count);
    }
    const PairFrame frame(points.points[r], points.normals[r]);
    for (int i = 0; i < count && isReference[r]; ++i)
    {
      if (i == r || (haveDirections && (views[r] & views[i]) == 0))
      {
        continue;
      }
      const int key = quantizer.key(pairFeature(
        PairFeatureKind::Surface, points.points[r], points.normals[r], points.points[i], points.normals[i]));
      if (key >= 0)
      {
        requireRoom(entries.size() + 1, "surface", "SurfaceLeafSize");
        entries.push_back({ static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(r),
          static_cast<std::uint32_t>(i), frame.angleOf(points.points[i]), 0u });
      }
    }
  }
  model.surfaceTable = makePairTable(entries, quantizer.numberOfKeys());
}

/// FNV-1a over the bytes of what was trained on.
class Digest
{
public:
  template <typename T>
  void add(const T& value)
  {
    this->bytes(&value, sizeof(T));
  }
  void add(const Points& points)
  {
    for (const auto& point : points)
    {
      this->bytes(point.data(), sizeof(float) * 3);
    }
  }
  std::string text() const
  {
    static const char* digits = "0123456789abcdef";
    std::string result;
    for (int shift = 60; shift >= 0; shift -= 4)
    {
      result += digits[(this->Value >> shift) & 15];
    }
    return result;
  }

private:
  void bytes(const void* data, std::size_t size)
  {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i)
    {
      this->Value = (this->Value ^ byte[i]) * 0x100000001B3ull;
    }
  }
  std::uint64_t Value = 0xCBF29CE484222325ull;
};
}

MEAMHashingSettings paperHashingSettings()
{
  MEAMHashingSettings settings;
  settings.features = Features::Edges;
  settings.feature = PairFeatureKind::Paper;
  settings.angleStep = 3.6;
  settings.merging = ViewMerging::VoxelCodes;
  settings.voxelSize = 1.0;
  settings.coVisibilityDirections = 0;
  return settings;
}

TrainedModel hashModels(const std::vector<AppearanceModel>& edgeModels, const PartGeometry& part,
  const MEAMHashingSettings& settings, const Progress& progress)
{
  const PointCloud& surface = part.samples;
  if (edgeModels.size() > TrainedModel::MaximumViews || settings.coVisibilityDirections > TrainedModel::MaximumViews)
  {
    throw Error("There are more than 32 appearance models or co-visibility directions: use fewer viewpoints.");
  }
  requirePositive("distance step", settings.distanceStep, 1.0, " of the diameter");
  requireWithin("angle step", settings.angleStep, 1.0, 90.0, " degrees");
  requirePositive("distance step of surface pairs", settings.surface.distanceStep, 1.0, " of the diameter");
  requireWithin("angle step of surface pairs", settings.surface.angleStep, 1.0, 90.0, " degrees");
  requirePositive("leaf size of surface pairs", settings.surface.leafSize, 1.0, " of the diameter");
  if (surface.normals.size() != surface.size())
  {
    throw Error("The part's surface has no normals: sample the surface of a mesh first.");
  }
  if (!hasEdges(settings.features) && surface.empty())
  {
    throw Error(
      "Pairs of surface points need samples of the part's surface: give them, or train edges alone (Features: Edges).");
  }
  TrainedModel model;
  model.settings = settings;
  model.settings.features = surface.empty() ? Features::Edges : settings.features;
  model.symmetries = part.symmetries;
  Points everything = surface.points;
  for (const AppearanceModel& view : edgeModels)
  {
    if (view.cloud.tangents.size() != view.cloud.size())
    {
      throw Error("Edge appearance model " + view.name + " has no tangents: estimate them before hashing.");
    }
    model.viewDirections.push_back(view.direction);
    everything.insert(everything.end(), view.cloud.points.begin(), view.cloud.points.end());
  }
  model.diameter = part.diameter > 0.0 ? part.diameter : diameter(everything);
  const double voxelSize = settings.voxelSize > 0.0 ? settings.voxelSize : VoxelShare * model.diameter;
  if (std::max(model.quantizer().numberOfKeys(), model.surfaceQuantizer().numberOfKeys()) > TrainedModel::MostKeys)
  {
    throw Error("The pair table would have more than 50 million keys: enlarge the distance step or the angle step.");
  }
  collectEdges(edgeModels, voxelSize, model, subProgress(progress, 0.0, 0.1));
  if (model.edges.size() < 2)
  {
    throw Error("The appearance models have no edges: the part shows no boundary from these viewpoints, or the "
                "surface is sampled too coarsely.");
  }
  const int voters = bringVotersForward(model);
  const std::vector<std::uint32_t> surfaceBits =
    visibilityBits(surface.points, settings.coVisibilityDirections, subProgress(progress, 0.1, 0.7));
  model.edgeVisible = edgeVisibility(model.edges, surface, surfaceBits, EdgeVoxels * voxelSize);
  for (const int i : thinSamples(surface, SurfaceLeafShare * model.diameter, model.diameter))
  {
    model.surface.points.push_back(surface.points[i]);
    model.surface.normals.push_back(surface.normals[i]);
  }
  if (hasEdges(settings.features))
  {
    const std::vector<PairEntry> pairs = EdgePairs(model, voters, voxelSize).find(subProgress(progress, 0.7, 0.9));
    model.table = makePairTable(pairs, model.quantizer().numberOfKeys());
  }
  if (hasSurface(model.settings.features))
  {
    buildSurfaceTable(model, surface, surfaceBits, voxelSize, subProgress(progress, 0.9, 1.0));
  }
  model.deriveFields();
  Digest digest;
  digest.add(surface.points);
  digest.add(model.edges.points);
  digest.add(model.edges.tangents);
  for (const ContinuousSymmetry& symmetry : part.symmetries.continuous)
  {
    digest.add(symmetry);
  }
  for (const Eigen::Isometry3d& S : part.symmetries.discrete)
  {
    digest.add(S.matrix());
  }
  for (const NearSymmetry& symmetry : part.symmetries.near)
  {
    digest.add(symmetry.T.matrix());
  }
  digest.add(settings.features);
  digest.add(settings.surface.distanceStep);
  digest.add(settings.surface.angleStep);
  digest.add(settings.surface.leafSize);
  digest.add(settings.feature);
  digest.add(settings.distanceStep);
  digest.add(settings.angleStep);
  digest.add(settings.merging);
  digest.add(settings.voxelSize);
  digest.add(settings.leafSize);
  digest.add(settings.coVisibilityDirections);
  model.digest = digest.text();
  report(progress, 1.0);
  return model;
}
}
