// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/ModelValidation.h"

#include "TestFiles.h"
#include "TestScene.h"

#include <functional>
#include <limits>

namespace
{
/// A way to damage a model, and what the message says of it.
struct Damage
{
  const char* name;
  std::function<void(meam::TrainedModel&)> apply;
  std::string said;
};
class ModelValidation : public testing::TestWithParam<Damage>
{
};

Eigen::Isometry3d mirroring() { return Eigen::Isometry3d(Eigen::Matrix4d(Eigen::Vector4d(-1, 1, 1, 1).asDiagonal())); }
}

TEST(ModelValidationOfWhole, AcceptsWhatTrainingMakes) { EXPECT_NO_THROW(meam::requireModel(scenes::bracket())); }

TEST(ModelValidationOfWhole, VersionIsNamed)
{
  EXPECT_NO_THROW(meam::requireModelVersion(meam::TrainedModel::FormatVersion));
  const int next = meam::TrainedModel::FormatVersion + 1;
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::requireModelVersion(next); }), std::to_string(next)));
}

TEST_P(ModelValidation, IsRefusedWithItsCause)
{
  meam::TrainedModel model = scenes::bracket();
  GetParam().apply(model);
  const std::string message = files::errorOf([&] { meam::requireModel(model); });
  EXPECT_TRUE(files::contains(message, GetParam().said)) << message;
  EXPECT_TRUE(files::contains(message, "Train the model again")) << message;
}

INSTANTIATE_TEST_SUITE_P(Damaged, ModelValidation,
  testing::Values(Damage{ "NoDiameter", [](auto& m) { m.diameter = 0.0; }, "has no diameter" },
    Damage{ "DiameterNotANumber", [](auto& m) { m.diameter = NAN; }, "has no diameter" },
    Damage{ "DiameterOfNothing", [](auto& m) { m.diameter = 1e-45; }, "diameter" },
    Damage{ "DiameterTooSmall", [](auto& m) { m.diameter = 1.0; }, "farther apart" },
    Damage{ "AngleStep", [](auto& m) { m.settings.angleStep = 0.5; }, "angle step that is out of range" },
    Damage{ "AngleStepNotANumber", [](auto& m) { m.settings.angleStep = NAN; }, "step" },
    Damage{ "DistanceStep", [](auto& m) { m.settings.distanceStep = 1.5; }, "step" },
    Damage{ "LeafNotANumber", [](auto& m) { m.settings.leafSize = NAN; }, "leaf size" },
    Damage{ "SurfaceLeaf", [](auto& m) { m.settings.surface.leafSize = 0.0; }, "leaf size" },
    Damage{ "SurfaceAngleStep", [](auto& m) { m.settings.surface.angleStep = NAN; }, "surface points" },
    Damage{ "TooManyKeys", [](auto& m) { m.settings.distanceStep = 1e-9; }, "too small" },
    Damage{ "TooManyKeysOfBothSteps",
      [](auto& m)
      {
        m.settings.distanceStep = 1e-3;
        m.settings.angleStep = 1.0;
      },
      "too small" },
    Damage{ "NoEdges", [](auto& m) { m.edges = {}; }, "no edge points" },
    Damage{ "TangentMissing", [](auto& m) { m.edges.tangents.pop_back(); }, "no edge points" },
    Damage{ "ViewsOfAnEdgeMissing", [](auto& m) { m.edgeViews.pop_back(); }, "its views" },
    Damage{ "DirectionsOfAnEdgeMissing", [](auto& m) { m.edgeVisible.pop_back(); }, "not every edge point" },
    Damage{ "EdgeNotANumber", [](auto& m) { m.edges.points[3].y() = NAN; }, "edge points are not" },
    Damage{ "TangentNotANumber", [](auto& m) { m.edges.tangents[3].y() = NAN; }, "tangents" },
    Damage{ "TangentNotFinite", [](auto& m) { m.edges.tangents[3].z() = INFINITY; }, "not numbers" },
    Damage{ "EdgeFarAway", [](auto& m) { m.edges.points[3].x() = 1e6f; }, "farther apart" },
    Damage{ "SurfaceFarAway", [](auto& m) { m.surface.points[0].x() = 1e6f; }, "farther apart" },
    Damage{ "NoViews", [](auto& m) { m.viewDirections.clear(); }, "0 views" },
    Damage{ "ViewNotUnit", [](auto& m) { m.viewDirections[0] *= 2.0f; }, "unit vectors" },
    Damage{ "UnknownView", [](auto& m) { m.edgeViews[0] = 1u << 31; }, "ViewBits" },
    Damage{ "SeenNowhere", [](auto& m) { m.edgeViews[0] = 0; }, "ViewBits" },
    Damage{ "NormalMissing", [](auto& m) { m.surface.normals.pop_back(); }, "without normals" },
    Damage{ "NormalNotANumber", [](auto& m) { m.surface.normals[2].x() = NAN; }, "not numbers" },
    Damage{ "Mirrored", [](auto& m) { m.symmetries.discrete.push_back(mirroring()); }, "symmetries" },
    Damage{
      "SymmetryOfNothing", [](auto& m) { m.symmetries.discrete.emplace_back(Eigen::Matrix4d::Zero()); }, "symmetries" },
    Damage{ "AxisNotUnit",
      [](auto& m) {
        m.symmetries.continuous.push_back({ { 0, 0, 2 }, { 0, 0, 0 } });
      },
      "symmetries" },
    Damage{ "OverlapNotANumber",
      [](auto& m) {
        m.symmetries.near.push_back({ Eigen::Isometry3d::Identity(), NAN, 0.0 });
      },
      "symmetries" },
    Damage{ "TableOfAnotherPoint", [](auto& m) { m.table.referreds[0] = static_cast<std::uint32_t>(m.edges.size()); },
      "does not fit its edge points" },
    Damage{
      "TableOfAnotherReference", [](auto& m) { m.table.references[7] = 4000000000u; }, "does not fit its edge points" },
    Damage{ "TableCut", [](auto& m) { m.table.offsets.pop_back(); }, "does not fit its edge points" },
    Damage{ "TableNotSorted", [](auto& m) { m.table.offsets[1] = m.table.offsets.back() + 1; },
      "does not fit its edge points" },
    Damage{ "AngleBeyondPi", [](auto& m) { m.table.angles[0] = 4.0f; }, "does not fit its edge points" },
    Damage{ "AngleNotANumber", [](auto& m) { m.table.angles[7] = NAN; }, "does not fit its edge points" },
    Damage{ "ViewsOfAPairMissing", [](auto& m) { m.table.viewBits.pop_back(); }, "does not fit its edge points" },
    Damage{ "SurfaceTableCut", [](auto& m) { m.surfaceTable.angles.pop_back(); }, "does not fit its surface points" },
    Damage{ "SurfaceKeysCut", [](auto& m) { m.surfaceTable.offsets.pop_back(); }, "surface points" },
    Damage{
      "SurfaceTableOfAnotherPoint", [](auto& m) { m.surfaceTable.references[7] = 4000000000u; }, "surface points" },
    Damage{ "SurfacePairNormalMissing", [](auto& m) { m.surfacePairPoints.normals.pop_back(); }, "surface points" },
    Damage{ "SurfacePairPointNotANumber", [](auto& m) { m.surfacePairPoints.points[0].x() = NAN; }, "not numbers" },
    Damage{ "TableWithoutItsFeatures", [](auto& m) { m.settings.features = meam::Features::Edges; },
      "which it does not hold" }),
  [](const testing::TestParamInfo<Damage>& damage) { return damage.param.name; });
