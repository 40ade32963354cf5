// SPDX-License-Identifier: BSD-3-Clause
#include "model/ModelValidation.h"

#include "TestFiles.h"
#include "TestScene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace
{
constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();

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
  testing::Values(Damage{ "NoDiameter", [](meam::TrainedModel& m) { m.diameter = 0.0; }, "has no diameter" },
    Damage{ "DiameterNotANumber", [](meam::TrainedModel& m) { m.diameter = NotANumber; }, "has no diameter" },
    Damage{ "AngleStep", [](meam::TrainedModel& m) { m.settings.angleStep = 0.5; }, "angle step that is out of range" },
    Damage{ "SurfaceLeaf", [](meam::TrainedModel& m) { m.settings.surface.leafSize = 0.0; }, "leaf size" },
    Damage{ "TooManyKeys",
      [](meam::TrainedModel& m)
      {
        m.settings.distanceStep = 1e-3;
        m.settings.angleStep = 1.0;
      },
      "too small" },
    Damage{ "NoEdges", [](meam::TrainedModel& m) { m.edges = {}; }, "no edge points" },
    Damage{ "ViewsOfAnEdgeMissing", [](meam::TrainedModel& m) { m.edgeViews.pop_back(); }, "its views" },
    Damage{
      "EdgeNotANumber", [](meam::TrainedModel& m) { m.edges.points[3].y() = NotANumber; }, "edge points are not" },
    Damage{ "TangentNotANumber", [](meam::TrainedModel& m) { m.edges.tangents[3].y() = NotANumber; }, "tangents" },
    Damage{ "EdgeFarAway", [](meam::TrainedModel& m) { m.edges.points[3].x() = 1e6f; }, "farther apart" },
    Damage{ "NoViews", [](meam::TrainedModel& m) { m.viewDirections.clear(); }, "0 views" },
    Damage{ "ViewNotUnit", [](meam::TrainedModel& m) { m.viewDirections[0] *= 2.0f; }, "unit vectors" },
    Damage{ "UnknownView", [](meam::TrainedModel& m) { m.edgeViews[0] = 1u << 31; }, "ViewBits" },
    Damage{ "SeenNowhere", [](meam::TrainedModel& m) { m.edgeViews[0] = 0; }, "ViewBits" },
    Damage{ "NormalMissing", [](meam::TrainedModel& m) { m.surface.normals.pop_back(); }, "without normals" },
    Damage{ "Mirrored",
      [](meam::TrainedModel& m)
      {
        Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
        T.linear()(0, 0) = -1.0;
        m.symmetries.discrete.push_back(T);
      },
      "symmetries" },
    Damage{ "AxisNotUnit",
      [](meam::TrainedModel& m) {
        m.symmetries.continuous.push_back({ 2.0 * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero() });
      },
      "symmetries" },
    Damage{ "TableOfAnotherPoint",
      [](meam::TrainedModel& m) { m.table.referreds[0] = static_cast<std::uint32_t>(m.edges.size()); },
      "does not fit its edge points" },
    Damage{ "TableNotSorted", [](meam::TrainedModel& m) { m.table.offsets[1] = m.table.offsets.back() + 1; },
      "does not fit its edge points" },
    Damage{ "AngleBeyondPi", [](meam::TrainedModel& m) { m.table.angles[0] = 4.0f; }, "does not fit its edge points" },
    Damage{ "SurfaceTableCut", [](meam::TrainedModel& m) { m.surfaceTable.angles.pop_back(); },
      "does not fit its surface points" },
    Damage{ "TableWithoutItsFeatures", [](meam::TrainedModel& m) { m.settings.features = meam::Features::Edges; },
      "which it does not hold" }),
  [](const testing::TestParamInfo<Damage>& damage) { return damage.param.name; });
