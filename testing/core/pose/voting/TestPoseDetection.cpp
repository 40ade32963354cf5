// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "TestScene.h"
#include "TestSteps.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"

#include <array>
#include <tuple>

namespace
{
int right(const meam::Poses& poses, const std::vector<Eigen::Isometry3d>& truth, double millimetres, double degrees)
{
  return static_cast<int>(std::count_if(poses.begin(), poses.end(),
    [&](const meam::Pose& pose) { return scenes::isNearOne(pose, truth, millimetres, degrees); }));
}

/// Edges of copies of the model at these places.
meam::PointCloud edgesOf(const std::vector<Eigen::Isometry3d>& places)
{
  meam::PointCloud edges;
  for (const Eigen::Isometry3d& T : places)
  {
    const meam::PointCloud one = parts::moved(scenes::bracket().edges, T);
    edges.points.insert(edges.points.end(), one.points.begin(), one.points.end());
    edges.tangents.insert(edges.tangents.end(), one.tangents.begin(), one.tangents.end());
  }
  return edges;
}

/// The model's edges, moved: what voting should find exactly.
meam::PointCloud modelEdges(const Eigen::Isometry3d& T, float sign = 1.0f)
{
  meam::PointCloud edges = parts::moved(scenes::bracket().edges, T);
  for (auto& tangent : edges.tangents)
  {
    tangent *= sign;
  }
  return edges;
}

/// The best supported turn of one reference point, every vote of every pair counted on its own.
struct SlowPeak
{
  int votes = 0; ///< of three neighbouring bins, or of one
  int lead = 0;  ///< before all others
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

SlowPeak slowPeak(const meam::TrainedModel& model, const meam::PointCloud& referred, const meam::PairFrame& scene,
  const Eigen::Vector3f& tangent, const meam::PoseDetectionSettings& settings)
{
  constexpr int bins = 50; // of 7.2 degrees
  const auto framed = [&](std::uint32_t point)
  { return meam::PairFrame(model.edges.points[point], model.edges.tangents[point]); };
  const meam::PairFeatureQuantizer quantizer = model.quantizer();
  std::vector<std::array<int, bins>> counts(2 * model.table.votingPoints, std::array<int, bins>{});
  for (std::size_t i = 0; i < referred.size(); ++i)
  {
    const meam::PairFeature feature =
      meam::pairFeature(quantizer.kind(), scene.Origin, tangent, referred.points[i], referred.tangents[i]);
    const int key = quantizer.key(feature);
    if (key < 0 || feature.distance == 0.0f)
    {
      continue;
    }
    for (std::uint32_t k = model.table.offsets[key]; k < model.table.offsets[key + 1]; ++k)
    {
      const std::uint32_t point = model.table.references[k];
      const Eigen::Vector3f& other = model.edges.points[model.table.referreds[k]];
      const meam::PairFrame part = framed(point);
      const bool flip = settings.signedTangents && part.against(other) != scene.against(referred.points[i]);
      const double angle = scene.angleOf(referred.points[i]);
      const double turns = (flip ? angle + part.angleOf(other) : angle - part.angleOf(other)) / (2.0 * M_PI) + 2.0;
      ++counts[2 * point + (flip ? 1 : 0)][static_cast<int>(std::floor(turns * bins)) % bins];
    }
  }
  SlowPeak best;
  for (std::size_t sheet = 0; sheet < counts.size(); ++sheet)
  {
    for (int bin = 0; bin < bins; ++bin)
    {
      const int beside = settings.smoothPeaks ? 1 : 0;
      const int before = beside * counts[sheet][(bin + bins - 1) % bins];
      const int after = beside * counts[sheet][(bin + 1) % bins];
      const int sum = before + counts[sheet][bin] + after;
      if (sum > best.votes)
      {
        best.lead = sum - best.votes;
        best.votes = sum;
        const double alpha = (bin + 0.5 + static_cast<double>(after - before) / sum) * 2.0 * M_PI / bins;
        best.pose = meam::alignFrames(framed(sheet / 2), scene, sheet % 2 == 1, alpha);
      }
      else
      {
        best.lead = std::min(best.lead, best.votes - sum);
      }
    }
  }
  return best;
}
}

TEST(PoseDetection, AMovedPartIsFoundAgain)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 4; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 300.0);
    for (const float sign : { 1.0f, -1.0f })
    {
      const meam::Poses poses = scenes::detect(modelEdges(T, sign), scenes::bracket());
      ASSERT_GT(poses.size(), 10u);
      EXPECT_GE(right(poses, { T }, 3.0, 6.0), static_cast<int>(0.8 * poses.size())) << "sign " << sign;
    }
  }
}

TEST(PoseDetection, TheSameForAnyNumberOfThreads)
{
  const auto foundBy = [](int threads)
  {
    meam::PoseDetectionSettings settings;
    settings.threads = threads;
    return scenes::detect(scenes::seenCopies().edges, scenes::bracket(), settings);
  };
  EXPECT_TRUE(scenes::areSame(foundBy(1), foundBy(3)));
}

TEST(PoseDetection, TheSeedChoosesTheReferencePoints)
{
  const auto foundBy = [](unsigned seed)
  {
    meam::PoseDetectionSettings settings;
    settings.seed = seed;
    return scenes::detect(modelEdges(Eigen::Isometry3d::Identity()), scenes::bracket(), settings);
  };
  EXPECT_TRUE(scenes::areSame(foundBy(1), foundBy(1)));
  EXPECT_FALSE(scenes::areSame(foundBy(1), foundBy(2)));
}

TEST(PoseDetection, EdgesFoundInAScanHaveMoreReferencePoints)
{
  const auto copies = [](int count, bool fromScan)
  {
    const auto places = meam::ofIndices<Eigen::Isometry3d>(
      count, [&](int copy) { return Eigen::Isometry3d(Eigen::Translation3d(200.0 * copy, 0, 0)); });
    meam::LocalCloud edges;
    edges.cloud = edgesOf(places);
    edges.fromScan = fromScan;
    return edges;
  };
  const auto candidates = [&](int count, bool fromScan)
  { return static_cast<double>(meam::detectPoses(copies(count, fromScan), scenes::bracket()).size()); };
  // All edges of the part are more than one view of it shows: up to four copies each, ten points of each.
  const double ofBoundary = candidates(100, false);
  EXPECT_GE(ofBoundary, 1000.0);
  EXPECT_LE(ofBoundary, 4000.0);
  EXPECT_NEAR(candidates(50, false), 0.5 * ofBoundary, 0.01 * ofBoundary) << "as many for each copy";
  EXPECT_NEAR(candidates(100, true), 4.0 * ofBoundary, 4.0);
  EXPECT_EQ(candidates(2, false), 100.0) << "no fewer";
  const meam::LocalCloud edges = copies(1, true);
  const double all = static_cast<double>(edges.cloud.size());
  EXPECT_EQ(candidates(1, true), all) << "fewer than 3000";
  const meam::LocalCloud many = copies(20, true);
  EXPECT_EQ(static_cast<double>(meam::detectPoses(many, scenes::bracket(), scenes::withShare(0.75)).size()),
    std::ceil(15.0 * all))
    << "whatever they come from";
}

TEST(PoseDetection, ByTheSurfaceAlone)
{
  // Tilted, so that the sensor sees three faces of each: pairs on one plane tell nothing.
  const auto copies = meam::ofIndices<Eigen::Isometry3d>(3,
    [&](int copy) -> Eigen::Isometry3d
    {
      return Eigen::Translation3d(120.0 * copy, 0, 0) * Eigen::AngleAxisd(1.1 * copy, Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(0.7 + 0.1 * copy, Eigen::Vector3d(1, 0.6, 0).normalized());
    });
  const meam::Scene scene = scenes::prepared(scenes::withTangents(scenes::seenFromAbove(copies)));
  meam::PoseDetectionSettings settings;
  const auto candidates = [&](meam::Features features)
  {
    settings.features = features;
    return meam::toSceneFrame(
      meam::detectPoses(scene, scenes::bracket(), settings), scene.T_local_scene(), scenes::bracket().symmetries);
  };
  const meam::Poses edges = candidates(meam::Features::Edges), surface = candidates(meam::Features::Surface);
  EXPECT_EQ(candidates(meam::Features::Both).size(), edges.size() + surface.size());
  for (const auto& T : copies)
  {
    EXPECT_GE(right(surface, { T }, 6.0, 12.0), 1);
  }
  settings.threads = 1;
  const meam::Poses one = candidates(meam::Features::Surface);
  settings.threads = 3;
  EXPECT_TRUE(scenes::areSame(one, candidates(meam::Features::Surface)));
}

TEST(PoseDetection, SaysWhatTheModelOrTheSceneHasNot)
{
  scenes::Seen seen = scenes::seenCopies();
  meam::TrainedModel edges = scenes::bracket();
  edges.settings.features = meam::Features::Edges;
  meam::PoseDetectionSettings settings;
  settings.features = meam::Features::Surface;
  EXPECT_THROW(meam::detectPoses(scenes::prepared(seen), edges, settings), meam::Error);
  seen.surface.clear();
  EXPECT_THROW(meam::detectPoses(scenes::prepared(seen), scenes::bracket(), settings), meam::Error);
  settings.features = meam::Features::Both;
  EXPECT_FALSE(meam::detectPoses(scenes::prepared(seen), scenes::bracket(), settings).empty()) << "by its edges";
}

class PoseDetectionVotes : public testing::TestWithParam<std::pair<bool, bool>>
{
};

TEST_P(PoseDetectionVotes, CountsTheVotesOfAllPairs)
{
  const meam::TrainedModel& model = scenes::bracket();
  const scenes::Seen& seen = scenes::seenCopies();
  meam::PoseDetectionSettings settings = scenes::withShare(1.0);
  std::tie(settings.signedTangents, settings.smoothPeaks) = GetParam();
  const meam::LocalCloud local = meam::toLocalCloud(seen.edges);
  const meam::PointCloud& edges = local.cloud;
  const meam::Poses poses = meam::detectPoses(local, model, settings);
  const meam::PointCloud referred = edges.subset(meam::thinPoints(edges.points, model.votingLeaf()));
  ASSERT_EQ(poses.size(), edges.size()) << "every reference point finds pairs";
  int exact = 0, sure = 0;
  for (std::size_t r = 0; r < poses.size(); ++r)
  {
    const Eigen::Vector3f& stored = edges.tangents[r];
    const Eigen::Vector3f tangent = stored.x() < 0.0f ? Eigen::Vector3f(-stored) : stored;
    const SlowPeak peak = slowPeak(model, referred, meam::PairFrame(edges.points[r], tangent), tangent, settings);
    // Rounding may carry a vote over the border of its bin, which turns a pose of 30 votes by up to half a degree.
    EXPECT_NEAR(poses[r].votes, peak.votes, 2) << r;
    exact += poses[r].votes == peak.votes ? 1 : 0;
    if (poses[r].votes == peak.votes && peak.lead > 3)
    {
      ++sure;
      const Eigen::Isometry3d slow = meam::nearestEqual(peak.pose, poses[r].T_scene_model, model.symmetries);
      EXPECT_TRUE(scenes::areNear(poses[r].T_scene_model, slow, 0.5, 0.5)) << r;
    }
  }
  EXPECT_GT(exact, 0.98 * poses.size());
  EXPECT_GT(sure, 20);
}

INSTANTIATE_TEST_SUITE_P(SignedAndSmooth, PoseDetectionVotes,
  testing::Values(std::make_pair(true, true), std::make_pair(false, true), std::make_pair(true, false)));

TEST(PoseDetection, WithoutTheSignsOfTangentsHalfOfTheCandidatesAreWrong)
{
  std::mt19937 random(6);
  const auto truth = meam::ofIndices<Eigen::Isometry3d>(12,
    [&](int copy) -> Eigen::Isometry3d
    { return Eigen::Translation3d(1000.0 * copy, 0, 0) * parts::motion(random, 300.0); });
  const auto found = [&](bool withSigns)
  {
    meam::PoseDetectionSettings settings;
    settings.signedTangents = withSigns;
    return right(scenes::detect(edgesOf(truth), scenes::bracket(), settings), truth, 3.0, 6.0);
  };
  EXPECT_GT(found(false), 0.3 * found(true));
  EXPECT_LT(found(false), 0.7 * found(true));
}

TEST(PoseDetection, PointsOfOneCubeMakeOnePair)
{
  const auto mostVotes = [](const meam::PointCloud& edges)
  {
    const meam::Poses poses = scenes::detect(edges, scenes::bracket(), scenes::withShare(1.0));
    return std::max_element(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.votes < b.votes; })
      ->votes;
  };
  const meam::PointCloud once = modelEdges(Eigen::Isometry3d::Identity());
  meam::PointCloud twice = once;
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    twice.points.push_back(once.points[i] + Eigen::Vector3f(0.01f, 0.01f, 0.01f));
    twice.tangents.push_back(once.tangents[i]);
  }
  EXPECT_LT(mostVotes(twice), 1.2 * mostVotes(once));
}

TEST(PoseDetection, BadInput)
{
  const meam::PointCloud edges = modelEdges(Eigen::Isometry3d::Identity());
  steps::expectRefused<meam::PointCloud>([](const auto& cloud) { scenes::detect(cloud, scenes::bracket()); },
    { { [](auto& cloud) { cloud = {}; } }, { [](auto& cloud) { cloud.tangents.clear(); } },
      { [](auto& cloud)
        {
          for (auto& point : cloud.points)
          {
            point *= 0.001f;
          }
        },
        "1000" } }, // metres taken for millimetres
    edges);
  EXPECT_THROW(scenes::detect(edges, scenes::bracket(), scenes::withShare(1.1)), meam::Error);
  steps::expectStops([&](const meam::Progress& progress) { scenes::detect(edges, scenes::bracket(), {}, progress); });
}

TEST(PoseDetection, NearAPlaceAllPointsVote)
{
  const meam::Scene& scene = scenes::copiesScene();
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  const Eigen::Isometry3d T = scene.T_local_scene() * scenes::threeCopies()[1];
  const Eigen::Vector3f place = (T * middle).cast<float>();
  meam::PoseDetectionSettings settings;
  settings.features = meam::Features::Edges;
  meam::CandidateSearch search(scene, scenes::bracket(), settings);
  const meam::Poses near = search.near(place, 30.0);
  const meam::Points& points = scene.edgePoints().points;
  const auto within = std::count_if(
    points.begin(), points.end(), [&](const Eigen::Vector3f& point) { return (point - place).norm() <= 30.0f; });
  EXPECT_EQ(static_cast<std::ptrdiff_t>(near.size()), within);
  EXPECT_GT(right(near, { T }, 5.0, 8.0), 5);
  EXPECT_TRUE(search.near(place, 0.0).empty());
}

TEST(PoseDetection, SomeVotersAfterOthersFindWhatAllAtOnceDo)
{
  const meam::Scene& scene = scenes::copiesScene();
  meam::CandidateSearch search(scene, scenes::bracket());
  const std::size_t few = search.upTo(0.1).size();
  const meam::Poses half = search.upTo(0.5);
  const meam::Poses all = search.upTo(1.0);
  EXPECT_GT(few, 0u);
  EXPECT_LT(few, half.size() / 3);
  EXPECT_TRUE(scenes::areSame(search.upTo(0.5), all)) << "nobody's vote is taken back";
  EXPECT_TRUE(scenes::areSame(all, meam::detectPoses(scene, scenes::bracket())));
  EXPECT_TRUE(scenes::areSame(half, meam::CandidateSearch(scene, scenes::bracket()).upTo(0.5)));
}
