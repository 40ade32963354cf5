// SPDX-License-Identifier: BSD-3-Clause
#include "model/MEAMHashing.h"

#include "TestScene.h"
#include "TestSteps.h"
#include "base/sequences/Sequences.h"
#include "model/AppearanceModel.h"

#include <map>
#include <set>

using meam::AppearanceModel;
using meam::MEAMHashingSettings;

namespace
{
AppearanceModel view(const std::string& name, const meam::Points& points)
{
  AppearanceModel model;
  model.name = name;
  model.cloud.points = points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // A tangent of its own for each place, so that equal places have equal tangents.
    model.cloud.tangents.push_back(
      Eigen::Vector3f(std::sin(points[i].x()), std::cos(points[i].y()), 0.3f + points[i].z() / 50.0f).normalized());
  }
  return model;
}

const meam::Points Front = { { 0, 0, 0 }, { 10, 0, 0 }, { 0, 20, 0 }, { 7, 7, 1 } };
const meam::Points Back = { { 0, 0, 0 }, { 10, 0, 0 }, { 3, 4, -9 } }; // two places in common with Front

MEAMHashingSettings settings(bool merge)
{
  MEAMHashingSettings result;
  result.merging = merge ? meam::ViewMerging::Points : meam::ViewMerging::VoxelCodes;
  result.voxelSize = 1.0;
  result.coVisibilityDirections = 0;
  return result;
}

/// Each stored pair by its places, with its view bits.
std::map<std::array<float, 6>, std::uint32_t> pairsOf(const meam::TrainedModel& model)
{
  std::map<std::array<float, 6>, std::uint32_t> pairs;
  for (std::size_t k = 0; k < model.table.size(); ++k)
  {
    const auto& r = model.edges.points[model.table.references[k]];
    const auto& i = model.edges.points[model.table.referreds[k]];
    EXPECT_TRUE(
      pairs.emplace(std::array<float, 6>{ r.x(), r.y(), r.z(), i.x(), i.y(), i.z() }, model.table.viewBits[k]).second)
      << "stored twice";
  }
  return pairs;
}
}

TEST(MEAMHashing, EachPhysicalPairOnceAndOnlyWhatIsSeenTogether)
{
  for (const bool merge : { true, false })
  {
    const meam::TrainedModel model =
      meam::hashModels({ view("front", Front), view("back", Back) }, { {}, 40.0, {} }, settings(merge));
    EXPECT_EQ(model.edges.size(), merge ? 5u : 7u);
    const auto pairs = pairsOf(model);
    // 4 * 3 in front, 3 * 2 behind, of which the two of the common pair are the same.
    EXPECT_EQ(pairs.size(), 16u);
    EXPECT_EQ(pairs.at({ 0, 0, 0, 10, 0, 0 }), 3u);
    EXPECT_EQ(pairs.at({ 10, 0, 0, 0, 0, 0 }), 3u);
    EXPECT_EQ(pairs.at({ 0, 0, 0, 0, 20, 0 }), 1u);
    EXPECT_EQ(pairs.at({ 0, 0, 0, 3, 4, -9 }), 2u);
    EXPECT_EQ(pairs.count({ 0, 20, 0, 3, 4, -9 }), 0u); // on two sides of the part
  }
}

TEST(MEAMHashing, PairsOfOneVoxelCanBeStopped)
{
  const auto points =
    meam::ofIndices<Eigen::Vector3f>(200, [&](int k) { return Eigen::Vector3f(k % 10, k / 10, 0.01f * k); });
  MEAMHashingSettings coarse = settings(false);
  coarse.voxelSize = 1000.0; // of all
  int reports = 0;           // while pairs are looked for
  const auto progress = [&](double share) { return share < 0.7 || share >= 0.9 || ++reports < 3; };
  EXPECT_THROW(meam::hashModels({ view("front", points) }, { {}, 40.0, {} }, coarse, progress), meam::Aborted);
}

TEST(MEAMHashing, PairsThatOnlyADirectionShowsAreNotTakenForOneAnother)
{
  // Two views of one plate, its edge points in both, told apart by voxel code: a point pairs with itself
  // in the other view at distance 0, which is no pair.
  const meam::PointCloud surface =
    parts::facing(parts::lattice({ 0, 0 }, { 20, 20 }, 1.0f, 0.0f), Eigen::Vector3f::UnitZ());
  const meam::Points corners = { { 0, 0, 0 }, { 20, 0, 0 }, { 0, 20, 0 } };
  MEAMHashingSettings both = settings(false);
  both.coVisibilityDirections = 26;
  const meam::TrainedModel model =
    meam::hashModels({ view("one", corners), view("other", corners) }, { surface, 40.0, {} }, both);
  for (std::size_t k = 0; k < model.table.size(); ++k)
  {
    const auto& r = model.edges.points[model.table.references[k]];
    const auto& i = model.edges.points[model.table.referreds[k]];
    EXPECT_GT((r - i).norm(), 1.0f);
  }
  EXPECT_GE(model.table.size(), 6u);
}

TEST(MEAMHashing, SurfacePairsAreThoseThatADirectionShowsTogether)
{
  // Both faces of a thin plate, 20 mm wide, with normals apart: a pair has both points on one face.
  meam::PointCloud surface;
  for (const float side : { 1.0f, -1.0f })
  {
    for (const Eigen::Vector3f& point : parts::lattice({ 0, 0 }, { 20, 20 }, 1.0f, side))
    {
      surface.points.push_back(point);
      surface.normals.push_back(side * Eigen::Vector3f::UnitZ());
    }
  }
  const meam::Points corners = { { 0, 0, 1 }, { 20, 0, 1 }, { 0, 20, 1 } };
  MEAMHashingSettings thin = settings(true);
  thin.surface.leafSize = 0.25; // of 40 mm
  thin.coVisibilityDirections = 26;
  const auto trained = [&](meam::Features features)
  {
    thin.features = features;
    return meam::hashModels({ view("one", corners) }, { surface, 40.0, {} }, thin);
  };
  const meam::TrainedModel both = trained(meam::Features::Both);
  const meam::PointCloud& points = both.surfacePairPoints;
  ASSERT_GT(points.size(), 8u);
  std::size_t above = 0, below = 0;
  for (const Eigen::Vector3f& point : points.points)
  {
    ++(point.z() > 0.0f ? above : below);
  }
  EXPECT_EQ(both.surfaceTable.size(), above * (above - 1) + below * (below - 1)) << "each with each on its face";
  for (std::size_t k = 0; k < both.surfaceTable.size(); ++k)
  {
    EXPECT_EQ(points.points[both.surfaceTable.references[k]].z(), points.points[both.surfaceTable.referreds[k]].z());
  }
  EXPECT_GT(both.table.size(), 0u);
  const meam::TrainedModel edges = trained(meam::Features::Edges), alone = trained(meam::Features::Surface);
  EXPECT_EQ(edges.surfaceTable.size(), 0u);
  EXPECT_EQ(edges.table.size(), both.table.size());
  EXPECT_EQ(alone.table.size(), 0u);
  EXPECT_EQ(alone.surfaceTable.size(), both.surfaceTable.size());
  EXPECT_NE(edges.digest, both.digest);
  thin.coVisibilityDirections = 0;
  const meam::TrainedModel every = trained(meam::Features::Surface);
  const std::size_t count = every.surfacePairPoints.size();
  EXPECT_EQ(every.surfaceTable.size(), count * (count - 1)) << "without directions all pairs";
}

TEST(MEAMHashing, WithoutASurfaceTheModelHoldsEdgesAlone)
{
  MEAMHashingSettings choice = settings(true);
  EXPECT_EQ(
    meam::hashModels({ view("front", Front) }, { {}, 40.0, {} }, choice).settings.features, meam::Features::Edges);
  choice.features = meam::Features::Surface;
  EXPECT_THROW(meam::hashModels({ view("front", Front) }, { {}, 40.0, {} }, choice), meam::Error);
  choice.features = meam::Features::Both;
  choice.surface.angleStep = 0.5;
  EXPECT_THROW(meam::hashModels({ view("front", Front) }, { {}, 40.0, {} }, choice), meam::Error);
}

TEST(MEAMHashing, SeparateTablesKeepThePairsOfEachView)
{
  MEAMHashingSettings separate = settings(true);
  separate.merging = meam::ViewMerging::None;
  const meam::TrainedModel model =
    meam::hashModels({ view("front", Front), view("back", Back) }, { {}, 40.0, {} }, separate);
  EXPECT_EQ(model.edges.size(), Front.size() + Back.size());
  EXPECT_EQ(model.table.size(), Front.size() * (Front.size() - 1) + Back.size() * (Back.size() - 1));
  EXPECT_EQ(model.table.bytes(), 4 * (model.table.offsets.size() + 4 * model.table.size()));
}

TEST(MEAMHashing, OneOfEqualPointsIsAReference)
{
  // Two pairs of points that half a turn about z maps onto each other.
  const meam::Points points = { { 10, 0, 0 }, { -10, 0, 0 }, { 0, 15, 5 }, { 0, -15, 5 } };
  meam::Symmetries half;
  half.discrete.push_back(meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, Eigen::Vector3d::Zero()));
  const auto trained = [&](const meam::Symmetries& symmetries) {
    return meam::hashModels({ view("top", points) }, { {}, 40.0, symmetries }, settings(true));
  };
  EXPECT_EQ(trained({}).table.size(), 12u);
  const meam::TrainedModel model = trained(half);
  EXPECT_EQ(model.table.size(), 6u);
  EXPECT_NE(model.digest, trained({}).digest);
  EXPECT_EQ(model.symmetries.discrete.size(), 1u);
  const std::set<std::uint32_t> references(model.table.references.begin(), model.table.references.end());
  EXPECT_EQ(references.size(), 2u);
  for (const auto other : references)
  {
    EXPECT_EQ(references.count(other ^ 1u), 0u) << "both of a pair are references";
  }
}

TEST(MEAMHashing, EveryBucketHoldsThePairsOfItsKey)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::PairFeatureQuantizer quantizer = model.quantizer();
  ASSERT_EQ(static_cast<int>(model.table.offsets.size()), quantizer.numberOfKeys() + 1);
  EXPECT_EQ(model.table.offsets.front(), 0u);
  EXPECT_EQ(model.table.offsets.back(), model.table.size());
  std::size_t stored = 0;
  for (int key = 0; key < quantizer.numberOfKeys(); ++key)
  {
    ASSERT_LE(model.table.offsets[key], model.table.offsets[key + 1]);
    for (std::uint32_t k = model.table.offsets[key]; k < model.table.offsets[key + 1]; ++k)
    {
      const std::uint32_t r = model.table.references[k];
      const std::uint32_t i = model.table.referreds[k];
      const auto& edges = model.edges;
      ASSERT_EQ(quantizer.key(meam::pairFeature(
                  quantizer.kind(), edges.points[r], edges.tangents[r], edges.points[i], edges.tangents[i])),
        key);
      ASSERT_FLOAT_EQ(
        model.table.angles[k], meam::PairFrame(edges.points[r], edges.tangents[r]).angleOf(edges.points[i]));
      ++stored;
    }
  }
  // Brute force: all ordered pairs that some view or direction shows together.
  std::size_t expected = 0;
  for (int r = 0; r < model.table.votingPoints; ++r)
  {
    for (int i = 0; i < model.table.votingPoints; ++i)
    {
      expected +=
        r != i && model.edges.points[r] != model.edges.points[i] &&
            ((model.edgeViews[r] & model.edgeViews[i]) != 0 || (model.edgeVisible[r] & model.edgeVisible[i]) != 0)
          ? 1
          : 0;
    }
  }
  EXPECT_EQ(stored, expected);
}

TEST(MEAMHashing, OneEdgePointOfACubeVotes)
{
  const auto trained = [](double leafSize)
  {
    meam::AppearanceModel view;
    for (int k = 0; k < 40; ++k) // 1 mm apart
    {
      view.cloud.points.push_back({ k + 0.5f, 0.5f, 0.5f });
      view.cloud.tangents.push_back(Eigen::Vector3f::UnitX());
    }
    MEAMHashingSettings with = settings(true);
    with.voxelSize = 0.1;
    with.leafSize = leafSize;
    return meam::hashModels({ view }, {}, with);
  };
  const meam::TrainedModel thin = trained(4.0);
  EXPECT_EQ(thin.edges.size(), 40u) << "poses are verified on all";
  EXPECT_EQ(thin.table.votingPoints, 10);
  EXPECT_EQ(thin.table.size(), 90u);
  const meam::Points voting(thin.edges.points.begin(), thin.edges.points.begin() + 10);
  EXPECT_EQ(meam::thinPoints(voting, 4.0).size(), 10u) << "in different cubes";
  const meam::TrainedModel whole = trained(0.5);
  EXPECT_EQ(whole.table.votingPoints, 40);
  EXPECT_NE(whole.digest, thin.digest);
}

TEST(MEAMHashing, TrainingIsDeterministicAndTheDigestTellsModelsApart)
{
  const meam::TrainedModel again =
    meam::trainModel(parts::lBracket(), meam::trainingSettings(meam::Preset::Recommended));
  EXPECT_EQ(again.digest, scenes::bracket().digest);
  EXPECT_EQ(again.table.references, scenes::bracket().table.references);
  EXPECT_EQ(again.table.angles, scenes::bracket().table.angles);
  EXPECT_NE(scenes::bracket(meam::Preset::Paper).digest, scenes::bracket().digest);
}

TEST(MEAMHashing, PointsOnOppositeFacesDoNotPair)
{
  const meam::TrainedModel& model = scenes::bracket(meam::Preset::Paper);
  for (std::size_t k = 0; k < model.table.size(); ++k)
  {
    EXPECT_NE(model.table.viewBits[k], 0u);
    EXPECT_NE(model.edgeViews[model.table.references[k]] & model.edgeViews[model.table.referreds[k]], 0u);
  }
}

TEST(MEAMHashing, BadInput)
{
  EXPECT_THROW(meam::hashModels({}, {}), meam::Error);
  AppearanceModel bare = view("front", Front);
  bare.cloud.tangents.clear();
  EXPECT_THROW(meam::hashModels({ bare }, {}), meam::Error);
  EXPECT_THROW(meam::hashModels(std::vector<AppearanceModel>(33, view("v", Front)), {}), meam::Error);
  MEAMHashingSettings fine;
  fine.angleStep = 1.0;
  fine.distanceStep = 0.001;
  EXPECT_THROW(
    meam::hashModels({ view("front", Front) }, { {}, 40.0, {} }, fine), meam::Error); // 3 thousand million keys
  MEAMHashingSettings none;
  none.angleStep = 0.0;
  EXPECT_THROW(meam::hashModels({ view("front", Front) }, {}, none), meam::Error);
  steps::expectStops(
    [](const meam::Progress& progress) {
      meam::hashModels({ view("front", Front) }, { {}, 40.0, {} }, {}, progress);
    });
}
