// SPDX-License-Identifier: BSD-3-Clause
// Python module for ablation.py and siblings.py: the method with one decision switched off, on arrays. What a switch
// does not change is computed once for all switches of a scene.
#include "base/sequences/Sequences.h"
#include "baselines/BaselineSettings.h"
#include "evaluation/PoseEvaluation.h"
#include "io/MeshFile.h"
#include "io/cloud/PCDFile.h"
#include "io/PoseFile.h"
#include "mesh/ConvexHull.h"
#include "mesh/preparation/MeshPreparation.h"
#include "model/MirrorImage.h"
#include "model/ModelTraining.h"
#include "model/TrainedModel.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/edges/SceneEdgeExtraction.h"
#include "simulation/BinScene.h"
#include "simulation/parts/SamplePart.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <memory>

namespace py = pybind11;
using namespace meam;

namespace
{
/// The first stage of the online phase that a switch changes.
enum class Stage
{
  Edges,
  Scene,
  Voting,
  Ranking,
  Selection,
  None
};

struct Switch
{
  std::string name;
  std::string what;
  Stage from = Stage::None;
  std::function<void(DetectionSettings&)> detection = [](DetectionSettings&) {};
  std::function<void(TrainingSettings&, double)> training{}; ///< with the part's diameter
  std::function<void(SceneEdgeExtractionSettings&)> edges = [](SceneEdgeExtractionSettings&) {};
  bool withoutSurface = false;
  bool withoutNearSymmetries = false;
};

using ChangeTraining = std::function<void(TrainingSettings&, double)>;

Switch training(const char* name, const char* what, ChangeTraining change)
{
  Switch result{ name, what, Stage::Voting };
  result.training = std::move(change);
  return result;
}

Switch sceneEdges(const char* name, const char* what, std::function<void(SceneEdgeExtractionSettings&)> change)
{
  Switch result{ name, what, Stage::Edges };
  result.edges = std::move(change);
  return result;
}

void withoutFreeSpace(DetectionSettings& settings)
{
  settings.screening->freeSpace = settings.candidateVerification.evidence.freeSpace =
    settings.verification.evidence.freeSpace = settings.selection.evidence.freeSpace =
      settings.selection.comparison.freeSpace = false;
}

void byEdgeCoverage(DetectionSettings& settings)
{
  settings.candidateVerification.method = settings.verification.method = VerificationMethod::EdgeCoverage;
  settings.candidateSelection.method = settings.selection.method = SelectionMethod::Clusters;
}

void withoutNoise(DetectionSettings& settings)
{
  settings.candidateVerification.evidence.followsNoise = settings.verification.evidence.followsNoise =
    settings.selection.evidence.followsNoise = settings.scene.followsNoise = false;
}

std::vector<Switch> makeSwitches()
{
  std::vector<Switch> all{ { "none", "nothing" } };
  const auto add = [&](Stage from, const char* name, const char* what, std::function<void(DetectionSettings&)> change) {
    all.push_back({ name, what, from, std::move(change) });
  };
  using D = DetectionSettings;
  using T = TrainingSettings;
  // Instances
  const auto instances = [&](const char* name, const char* what, std::function<void(PoseSelectionSettings&)> change)
  { add(Stage::Selection, name, what, [change = std::move(change)](D& d) { change(d.selection); }); };
  using S = PoseSelectionSettings;
  instances(
    "restarts", "no restarts of the refinement", [](S& s) { s.search.halfTurns = s.search.smallTurns = false; });
  instances("half-turns", "no restarts at half turns", [](S& s) { s.search.halfTurns = false; });
  instances("small-turns", "no restarts at small turns", [](S& s) { s.search.smallTurns = false; });
  instances("rotation-search", "no search about a round axis", [](S& s) { s.search.aboutAxis = false; });
  instances("rotation-decision", "no decision between near-symmetries", [](S& s) { s.search.nearSymmetries = false; });
  instances("depth-fit", "rotations without the depth point by point", [](S& s) { s.search.depthFit = false; });
  instances("ascent", "no maximization of the log odds", [](S& s) { s.search.maximizes = false; });
  instances("ascent-past", "the same where the sensor saw past", [](S& s) { s.search.pattern.ifPast = false; });
  instances("ascent-close", "the same where something close hides", [](S& s) { s.search.pattern.ifClose = false; });
  instances("ascent-covered", "likely poses move that something close hides",
    [](S& s) { s.search.pattern.leavesLikely = false; });
  instances("ascent-orders", "one order of motions", [](S& s) { s.search.pattern.bothOrders = false; });
  instances("ascent-price", "no penalty of a moved pose", [](S& s) { s.search.pattern.penalizes = false; });
  instances("shared", "poses that share their surface stay", [](S& s) { s.dropsShared = false; });
  instances("overlaps", "poses may cut into each other", [](S& s) { s.excludesOverlaps = false; });
  instances("lookalikes", "what contradicts a pose speaks for no other part", [](S& s) { s.weighsLookalikes = false; });
  instances("mirror-image", "no pose is of the mirrored part", [](S& s) { s.weighsMirrorImage = false; });
  instances(
    "common-differences", "most copies may differ from the part alike", [](S& s) { s.weighsDifferences = false; });
  instances("part-size", "parts may be of another size", [](S& s) { s.weighsSize = false; });
  instances("comparison", "instances by their evidence alone", [](S& s) { s.comparesInstances = false; });
  instances("alignment", "no final alignment", [](S& s) { s.search.aligns = false; });
  instances(
    "own-visibility", "rotations each judged on all they predict", [](S& s) { s.comparison.sameVisibility = false; });
  // Candidates
  add(Stage::Ranking, "rates", "usual rates, not the scan's",
    [](D& d) { d.candidateVerification.evidence.rates = EvidenceRates{}; });
  add(Stage::Ranking, "screening", "no screening", [](D& d) { d.screening.reset(); });
  add(Stage::Ranking, "alternatives", "one candidate of an instance",
    [](D& d) { d.candidateSelection.alternatives = 1; });
  add(Stage::Ranking, "alternatives-2", "two", [](D& d) { d.candidateSelection.alternatives = 2; });
  add(Stage::Ranking, "candidates-60", "60 candidates refined, likely or not",
    [](D& d) { d.candidateSelection.maximumPoses = 60; });
  add(Stage::Ranking, "candidates-25", "25", [](D& d) { d.candidateSelection.maximumPoses = 25; });
  add(Stage::Ranking, "noise", "tolerances that do not grow with the noise", withoutNoise);
  add(Stage::Ranking, "free-space", "what the sensor saw past does not count", withoutFreeSpace);
  add(Stage::Ranking, "coverage", "verification by edge coverage", byEdgeCoverage);
  add(Stage::Ranking, "point-to-point", "point-to-point ICP",
    [](D& d)
    {
      d.refinement = paperRefinementSettings();
      d.refinement.threads = 1;
    });
  add(Stage::Ranking, "last-step", "refinement by some of the points to the end",
    [](D& d) { d.refinement.fullLastStep = false; });
  add(Stage::Ranking, "edge-stride", "all predicted edge points, not every other one",
    [](D& d)
    {
      d.candidateVerification.evidence.edgeStride = d.verification.evidence.edgeStride = 1;
      d.selection.evidence.edgeStride = 1;
    });
  // Scene
  add(Stage::Scene, "enclosure", "floor and walls not looked for", [](D& d) { d.scene.findsEnclosure = false; });
  add(Stage::Scene, "long-lines", "edges longer than the part count", [](D& d) { d.scene.findsLongLines = false; });
  add(Stage::Scene, "line-noise", "tangents whose lengths do not grow with the noise",
    [](D& d) { d.tangents.followsNoise = false; });
  all.push_back(
    sceneEdges("image-edges", "no edges of the image", [](SceneEdgeExtractionSettings& s) { s.imageEdges = false; }));
  all.push_back(
    sceneEdges("depth-edges", "no depth jumps", [](SceneEdgeExtractionSettings& s) { s.depthEdges = false; }));
  all.push_back(sceneEdges("creases", "no creases", [](SceneEdgeExtractionSettings& s) { s.creases = false; }));
  all.push_back({ "edges", "edges alone, no surface", Stage::Edges });
  all.back().withoutSurface = true;
  // Voting
  add(Stage::Voting, "edge-pairs", "pairs of edge points alone", [](D& d) { d.detection.features = Features::Edges; });
  add(Stage::Voting, "surface-pairs", "pairs of surface points alone",
    [](D& d) { d.detection.features = Features::Surface; });
  add(Stage::Voting, "signs", "signs of tangents not looked at", [](D& d) { d.detection.signedTangents = false; });
  add(Stage::Voting, "one-turn", "peaks of one bin, not of three", [](D& d) { d.detection.smoothPeaks = false; });
  add(Stage::Voting, "peaks", "two peaks of each reference", [](D& d) { d.detection.peaksPerReference = 2; });
  add(Stage::Voting, "scan-references", "as many references in a scan as of a boundary",
    [](D& d) { d.detection.moreInScans = false; });
  add(Stage::Voting, "long-buckets", "long buckets vote, too",
    [](D& d) { d.detection.longestBucket = std::numeric_limits<double>::max(); });
  // Training
  all.push_back(training(
    "tiles", "tangents by Algorithms 1 and 2", [](T& t, double) { t.tangents.method = TangentMethod::Tiles; }));
  all.back().from = Stage::Scene;
  all.back().detection = [](D& d) { d.tangents.method = TangentMethod::Tiles; };
  const auto train = [&](const char* name, const char* what, ChangeTraining change)
  { all.push_back(training(name, what, std::move(change))); };
  train(
    "gamma-100", "hidden points by a sphere of 100, not 1000", [](T& t, double) { t.visibility.radiusFactor = 1e2; });
  train("gamma-10000", "hidden points by a sphere of 10000", [](T& t, double) { t.visibility.radiusFactor = 1e4; });
  train("mesh-visibility", "hidden points by the mesh",
    [](T& t, double) { t.visibility.method = VisibilityMethod::MeshVisibility; });
  train(
    "mesh-edges", "boundary by the mesh's edges", [](T& t, double) { t.boundary.method = BoundaryMethod::MeshEdges; });
  train("paper-key", "the paper's key, three acute angles",
    [](T& t, double) { t.hashing.feature = PairFeatureKind::Paper; });
  train("angle-3.6", "steps of 3.6 degrees", [](T& t, double) { t.hashing.angleStep = 3.6; });
  train("angle-12", "steps of 12 degrees", [](T& t, double) { t.hashing.angleStep = 12.0; });
  train("distance-5", "steps of 5 % of D", [](T& t, double) { t.hashing.distanceStep = 0.05; });
  train("distance-10", "steps of 10 % of D", [](T& t, double) { t.hashing.distanceStep = 0.1; });
  train("common-views", "pairs of common views only", [](T& t, double) { t.hashing.coVisibilityDirections = 0; });
  train(
    "voxel-codes", "views merged by voxel codes", [](T& t, double) { t.hashing.merging = ViewMerging::VoxelCodes; });
  train("separate", "views not merged", [](T& t, double) { t.hashing.merging = ViewMerging::None; });
  train("more-votes", "one point of cubes of 3 % votes, not of 4 %",
    [](T& t, double diameter) { t.hashing.leafSize = 0.03 * diameter; });
  train("sparse-edges", "only points that vote judge, too",
    [](T& t, double diameter) { t.tangents.leafSize = 0.04 * diameter; });
  train("near", "no near-symmetries", [](T&, double) {});
  all.back().withoutNearSymmetries = true;
  return all;
}

const std::vector<Switch>& switches()
{
  static const std::vector<Switch> all = makeSwitches();
  return all;
}

const Switch& switchNamed(const std::string& name)
{
  const auto found =
    std::find_if(switches().begin(), switches().end(), [&](const Switch& one) { return one.name == name; });
  if (found == switches().end())
  {
    throw Error("There is no switch '" + name + "'.");
  }
  return *found;
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;
using Ints = py::array_t<int, py::array::c_style | py::array::forcecast>;

Points toPoints(const Floats& array)
{
  const auto* first = reinterpret_cast<const Eigen::Vector3f*>(array.data());
  return { first, first + array.size() / 3 };
}

Floats fromPoints(const Points& points, std::vector<py::ssize_t> shape)
{
  shape.push_back(3);
  return Floats(shape, points.empty() ? nullptr : points.front().data());
}

using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Poses toPoses(const Doubles& matrices)
{
  Poses poses(matrices.size() / 16);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].T_scene_model.matrix() = Eigen::Map<const Matrix>(matrices.data() + 16 * i);
  }
  return poses;
}

template <typename Of>
Doubles column(const Poses& poses, const Of& of)
{
  Doubles result(static_cast<py::ssize_t>(poses.size()));
  std::transform(poses.begin(), poses.end(), result.mutable_data(), of);
  return result;
}

Doubles matricesOf(const Poses& poses)
{
  Doubles result({ static_cast<py::ssize_t>(poses.size()), py::ssize_t{ 4 }, py::ssize_t{ 4 } });
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    Eigen::Map<Matrix>(result.mutable_data() + 16 * i) = poses[i].T_scene_model.matrix();
  }
  return result;
}

/// A mesh and its models, of each switch that changes training one.
class Part
{
public:
  Part(const Floats& vertices, const Ints& triangles)
  {
    this->Mesh.vertices = toPoints(vertices);
    for (py::ssize_t i = 0; i < triangles.size() / 3; ++i)
    {
      this->Mesh.triangles.emplace_back(
        triangles.data()[3 * i], triangles.data()[3 * i + 1], triangles.data()[3 * i + 2]);
    }
    this->Mesh = prepareMesh(this->Mesh).mesh;
  }

  const TrainedModel& model(const Switch& change)
  {
    std::unique_ptr<TrainedModel>& model = this->Models[change.training ? change.name : ""];
    if (!model)
    {
      TrainingSettings settings = trainingSettings(Preset::Recommended);
      if (change.training)
      {
        change.training(settings, diameter(this->Mesh.vertices));
      }
      model = std::make_unique<TrainedModel>(trainModel(this->Mesh, settings));
      if (change.withoutNearSymmetries)
      {
        model->symmetries.near.clear();
      }
    }
    return *model;
  }
  const TrainedModel& model() { return this->model(switches().front()); }

  TriangleMesh Mesh;

private:
  std::map<std::string, std::unique_ptr<TrainedModel>> Models;
};

struct Scan
{
  OrganizedCloud cloud;
  Image image;
  Points edges; ///< where they are known: image and grid tell nothing then
};

Scan makeScan(const Floats& points, const Bytes& image, const Floats& edges)
{
  Scan scan;
  scan.cloud = { static_cast<int>(points.shape(1)), static_cast<int>(points.shape(0)), toPoints(points) };
  scan.edges = toPoints(edges);
  if (image.size() > 0)
  {
    scan.image = { scan.cloud.width, scan.cloud.height, image.ndim() == 3 ? 3 : 1,
      std::vector<std::uint8_t>(image.data(), image.data() + image.size()) };
  }
  return scan;
}

SceneInput inputOf(const Scan& scan, const Switch& change)
{
  SceneInput input;
  if (scan.edges.empty())
  {
    SceneEdgeExtractionSettings settings = sceneEdgeSettings(Preset::Recommended);
    settings.threads = 1;
    settings.imageEdges = !scan.image.pixels.empty();
    change.edges(settings);
    const SceneEdges found = extractSceneEdges(scan.cloud, scan.image, settings);
    input.edges = toLocalCloud(found.cloud, 1);
    input.edges.fromScan = true;
    input.quality = found.quality;
  }
  else
  {
    PointCloud edges;
    edges.points = scan.edges;
    input.edges = toLocalCloud(edges, 1);
    input.sensor.perspective = false;
    input.sensor.direction = -Eigen::Vector3d::UnitZ();
  }
  if (!change.withoutSurface)
  {
    input.measured = toLocalPoints(scan.cloud.points, input.edges.T_local_scene, 1);
  }
  return input;
}

/// Seconds of processor time, of all threads.
double processorTime()
{
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What a stage returned, and the seconds that it and those before it took.
template <typename Value>
struct Timed
{
  Value value{};
  double seconds = 0.0;
};

template <typename Make>
auto timed(double before, const Make& make)
{
  const double start = processorTime();
  auto value = make();
  return Timed<decltype(value)>{ std::move(value), before + processorTime() - start };
}

/// What the stages before the last selection leave.
struct Ranked
{
  Poses verified;
  std::optional<EvidenceRates> rates;
};

/// What nothing that is switched off has changed.
struct Shared
{
  Timed<SceneInput> input;
  Timed<std::shared_ptr<Scene>> scene;
  Timed<Poses> candidates;
  Timed<Ranked> ranked;
};

/// The poses of a switch, from what is shared of the stages before it; with `keep` what the stages return is kept
/// there.
Timed<Poses> find(Part& part, const Scan& scan, const Switch& change, Shared& shared, bool keep)
{
  const TrainedModel& model = part.model(change);
  DetectionSettings settings = detectionSettings(Preset::Recommended, 0, 1);
  change.detection(settings);
  Shared own = shared;
  if (keep || change.from <= Stage::Edges)
  {
    own.input = timed(0.0, [&] { return inputOf(scan, change); });
  }
  if (keep || change.from <= Stage::Scene)
  {
    const SceneInput& input = own.input.value;
    own.scene = timed(own.input.seconds,
      [&]
      {
        LocalCloud edges =
          estimateTangents(input.edges, model.diameter, input.sensor.direction, settings.tangents).edges;
        return std::make_shared<Scene>(
          std::move(edges), input.measured, input.sensor, model.diameter, settings.scene, input.quality);
      });
  }
  const Scene& scene = *own.scene.value;
  if (keep || change.from <= Stage::Voting)
  {
    own.candidates = timed(own.scene.seconds, [&] { return detectPoses(scene, model, settings.detection); });
  }
  Timed<Poses> found;
  const auto select = [&](double before)
  {
    PoseSelectionSettings selection = settings.selection;
    selection.evidence.rates = own.ranked.value.rates;
    return timed(before, [&] { return selectPoses(own.ranked.value.verified, scene, model, selection); });
  };
  if (keep || change.from <= Stage::Ranking)
  {
    DetectionReport told;
    found = timed(own.candidates.seconds,
      [&]
      {
        return rankCandidates(own.candidates.value, scene, model, settings, &told, {},
          [&](PoseStage stage, const Poses& returned)
          {
            if (stage == PoseStage::Verification)
            {
              own.ranked.value.verified = returned;
            }
          });
      });
    own.ranked.value.rates = told.rates;
    own.ranked.seconds = keep ? found.seconds - select(0.0).seconds : 0.0;
  }
  else
  {
    found = select(own.ranked.seconds);
  }
  found.value = toSceneFrame(found.value, scene.T_local_scene(), model.symmetries);
  if (keep)
  {
    shared = own;
  }
  return found;
}

/// The poses in a scan by one switch after the other. Keeps references to both.
class Search
{
public:
  Search(Part& part, const Scan& scan)
    : OfPart(part)
    , InScan(scan)
  {
    ::find(part, scan, switches().front(), this->Stages, true); // fills the model's caches: times compare
    ::find(part, scan, switches().front(), this->Stages, true);
  }

  py::dict find(const std::string& name)
  {
    const Timed<Poses> found = ::find(this->OfPart, this->InScan, switchNamed(name), this->Stages, false);
    py::dict result;
    result["seconds"] = found.seconds;
    result["T"] = matricesOf(found.value);
    result["probability"] = column(found.value, probabilityOrScore);
    result["place"] = column(found.value, placeOrScore);
    result["continuing"] = column(found.value, [](const Pose& pose) { return pose.contradictions.continuing; });
    result["past"] = column(found.value, [](const Pose& pose) { return pose.contradictions.past; });
    result["missing"] = column(found.value, [](const Pose& pose) { return double(pose.contradictions.missing); });
    result["lengths"] = py::list();
    for (const Pose& pose : found.value)
    {
      const Eigen::Vector3d& lengths = pose.contradictions.lengths;
      result["lengths"].cast<py::list>().append(py::make_tuple(lengths.x(), lengths.y(), lengths.z()));
    }
    result["misfit"] = column(found.value, [](const Pose& pose) { return pose.contradictions.misfit; });
    return result;
  }

private:
  Part& OfPart;
  const Scan& InScan;
  Shared Stages;
};

/// How poses compare with the true ones; `equals` are the part's turns onto itself, without any the model's count.
py::dict judge(
  Part& part, const Doubles& found, const Doubles& truth, const Doubles& visible, double degrees, const Doubles& equals)
{
  PoseEvaluationSettings settings;
  const TrainedModel& model = part.model();
  settings.diameter = model.diameter;
  settings.middle = model.visibility->middle().cast<double>();
  settings.symmetries = model.symmetries;
  if (equals.size() > 0)
  {
    settings.symmetries = {};
    for (const Pose& turn : toPoses(equals))
    {
      settings.symmetries.discrete.push_back(turn.T_scene_model);
    }
  }
  settings.rotationTolerance = degrees;
  Poses truths = toPoses(truth);
  for (std::size_t i = 0; i < truths.size(); ++i)
  {
    truths[i].visibleFraction = visible.data()[i];
  }
  const SceneEvaluation scene = evaluatePoses(toPoses(found), truths, settings);
  std::vector<int> instance;
  std::vector<bool> duplicate, counts;
  for (const PoseJudgement& one : scene.judgements)
  {
    instance.push_back(one.instance);
    duplicate.push_back(one.duplicate);
  }
  for (const InstanceJudgement& one : scene.instances)
  {
    counts.push_back(one.counts);
  }
  py::dict result;
  result["instance"] = instance;
  result["duplicate"] = duplicate;
  result["counts"] = counts;
  return result;
}

/// The share of each true copy that nothing hides.
std::vector<double> visibleShares(Part& part, const Scan& scan, const Doubles& truth)
{
  const TrainedModel& model = part.model();
  const SceneInput input = inputOf(scan, switches().front());
  const Scene scene(estimateTangents(input.edges, model.diameter, input.sensor.direction).edges, input.measured,
    input.sensor, model.diameter, {}, input.quality);
  const EvidenceCollector collector(scene, model);
  return meam::mapped<double>(toPoses(truth),
    [&](const Pose& pose) { return collector.collect(scene.T_local_scene() * pose.T_scene_model).visibleFraction(); });
}

py::tuple arraysOf(const OrganizedCloud& cloud, const std::vector<std::uint8_t>& pixels, int channels)
{
  std::vector<py::ssize_t> shape{ cloud.height, cloud.width };
  const Floats points = fromPoints(cloud.points, shape);
  if (channels == 3)
  {
    shape.push_back(3);
  }
  return py::make_tuple(points, pixels.empty() ? Bytes(0) : Bytes(shape, pixels.data()));
}

py::tuple readScan(const std::string& path)
{
  const MeasuredCloud data = readPCD(path);
  return arraysOf(data.cloud, data.colors, 3);
}

py::tuple meshArrays(const TriangleMesh& mesh)
{
  std::vector<int> triangles;
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    triangles.insert(triangles.end(), triangle.data(), triangle.data() + 3);
  }
  const py::ssize_t count = static_cast<py::ssize_t>(mesh.triangles.size());
  return py::make_tuple(fromPoints(mesh.vertices, { static_cast<py::ssize_t>(mesh.vertices.size()) }),
    Ints(std::vector<py::ssize_t>{ count, 3 }, triangles.data()));
}

py::tuple simulate(const Part& part, int sensor, int copies, unsigned seed)
{
  BinSceneSettings settings = binSettings(static_cast<SensorKind>(sensor));
  settings.copies = copies;
  settings.seed = seed;
  const BinScene scene = simulateBin(part.Mesh, settings);
  Poses truth(scene.instances.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    truth[i].T_scene_model = scene.instances[i].T_scene_model;
    truth[i].visibleFraction = scene.instances[i].visibleFraction();
  }
  return arraysOf(scene.cloud, scene.image.pixels, scene.image.channels) +
         py::make_tuple(matricesOf(truth), column(truth, [](const Pose& pose) { return pose.visibleFraction; }));
}

Doubles readTransforms(const std::string& path)
{
  Poses poses;
  for (const Eigen::Isometry3d& T : readMatrices(path))
  {
    poses.emplace_back().T_scene_model = T;
  }
  return matricesOf(poses);
}
}

PYBIND11_MODULE(meamAblation, module)
{
  py::class_<Part>(module, "Part")
    .def(py::init<const Floats&, const Ints&>(), py::arg("vertices"), py::arg("triangles"))
    .def_property_readonly("mesh", [](const Part& part) { return meshArrays(part.Mesh); })
    .def_property_readonly("diameter", [](Part& part) { return part.model().diameter; })
    .def_property_readonly(
      "has_mirror_image", [](Part& part) { return part.model().mirrorImage->of(part.model()) != nullptr; });
  py::class_<Scan>(module, "Scan").def(py::init(&makeScan), py::arg("points"), py::arg("image"), py::arg("edges"));
  module.def("switches",
    []
    {
      py::dict result;
      for (const Switch& one : switches())
      {
        result[py::str(one.name)] = one.what;
      }
      return result;
    });
  py::class_<Search>(module, "Search")
    .def(py::init<Part&, const Scan&>(), py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
    .def("find", &Search::find, "Poses, best first, and the seconds that they took, with a switch");
  module.def("judge", &judge,
    "Of each pose the true copy, or -1, and whether a better one has it; of each copy whether it counts");
  module.def("visible_shares", &visibleShares);
  module.def("simulate", &simulate, "Points, image, true poses and their visible shares");
  module.def("read_scan", &readScan, "Points and image of a PCD file");
  module.def("read_mesh", [](const std::string& path) { return meshArrays(readMesh(path)); });
  module.def("read_transforms", &readTransforms);
  module.def("sample_part", [] { return meshArrays(makeSamplePart()); });
}
