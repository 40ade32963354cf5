// SPDX-License-Identifier: BSD-3-Clause
#include "model/ModelFile.h"

#include "TestFiles.h"
#include "TestScene.h"

#include <functional>

namespace
{
bool same(const std::vector<Eigen::Isometry3d>& a, const std::vector<Eigen::Isometry3d>& b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                   [](const auto& one, const auto& other) { return one.matrix() == other.matrix(); });
}

void expectSame(const meam::PairTable& a, const meam::PairTable& b)
{
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.references, b.references);
  EXPECT_EQ(a.referreds, b.referreds);
  EXPECT_EQ(a.angles, b.angles);
  EXPECT_EQ(a.viewBits, b.viewBits);
}

void expectSame(const meam::PointCloud& a, const meam::PointCloud& b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.tangents, b.tangents);
  EXPECT_EQ(a.pointIds, b.pointIds);
  EXPECT_EQ(a.edgeTypes, b.edgeTypes);
}

/// Bit by bit, but for what deriveFields() makes.
void expectSame(const meam::TrainedModel& a, const meam::TrainedModel& b)
{
  EXPECT_EQ(a.diameter, b.diameter);
  EXPECT_EQ(a.digest, b.digest);
  EXPECT_EQ(a.settings.features, b.settings.features);
  EXPECT_EQ(a.settings.surface.distanceStep, b.settings.surface.distanceStep);
  EXPECT_EQ(a.settings.surface.angleStep, b.settings.surface.angleStep);
  EXPECT_EQ(a.settings.surface.leafSize, b.settings.surface.leafSize);
  EXPECT_EQ(a.settings.feature, b.settings.feature);
  EXPECT_EQ(a.settings.distanceStep, b.settings.distanceStep);
  EXPECT_EQ(a.settings.angleStep, b.settings.angleStep);
  EXPECT_EQ(a.settings.merging, b.settings.merging);
  EXPECT_EQ(a.settings.voxelSize, b.settings.voxelSize);
  EXPECT_EQ(a.settings.leafSize, b.settings.leafSize);
  EXPECT_EQ(a.settings.coVisibilityDirections, b.settings.coVisibilityDirections);
  EXPECT_EQ(a.viewDirections, b.viewDirections);
  expectSame(a.edges, b.edges);
  EXPECT_EQ(a.edgeViews, b.edgeViews);
  EXPECT_EQ(a.edgeVisible, b.edgeVisible);
  expectSame(a.surface, b.surface);
  expectSame(a.table, b.table);
  expectSame(a.surfacePairPoints, b.surfacePairPoints);
  expectSame(a.surfaceTable, b.surfaceTable);
  EXPECT_EQ(a.calibration.place.constant, b.calibration.place.constant);
  EXPECT_EQ(a.calibration.place.slope, b.calibration.place.slope);
  EXPECT_EQ(a.calibration.rotation.constant, b.calibration.rotation.constant);
  EXPECT_EQ(a.calibration.rotation.slope, b.calibration.rotation.slope);
  EXPECT_EQ(a.calibration.poses, b.calibration.poses);
  EXPECT_TRUE(same(a.symmetries.discrete, b.symmetries.discrete));
  ASSERT_EQ(a.symmetries.continuous.size(), b.symmetries.continuous.size());
  for (std::size_t i = 0; i < a.symmetries.continuous.size(); ++i)
  {
    EXPECT_EQ(a.symmetries.continuous[i].axis, b.symmetries.continuous[i].axis);
    EXPECT_EQ(a.symmetries.continuous[i].point, b.symmetries.continuous[i].point);
  }
  ASSERT_EQ(a.symmetries.near.size(), b.symmetries.near.size());
  for (std::size_t i = 0; i < a.symmetries.near.size(); ++i)
  {
    EXPECT_EQ(a.symmetries.near[i].T.matrix(), b.symmetries.near[i].T.matrix());
    EXPECT_EQ(a.symmetries.near[i].overlap, b.symmetries.near[i].overlap);
    EXPECT_EQ(a.symmetries.near[i].deviation, b.symmetries.near[i].deviation);
  }
}

/// The bracket as if it had symmetries of all kinds, and had been calibrated.
meam::TrainedModel symmetricBracket()
{
  meam::TrainedModel model = scenes::bracket();
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  model.symmetries.discrete = { meam::turnAbout(axis, M_PI, { 1, 2, 3 }) };
  model.symmetries.continuous = { { axis, { 4, 5, 6 } } };
  model.calibration = { { 0.25, 0.75 }, { -0.5, 1.5 }, 40 };
  model.symmetries.near = { { meam::turnAbout(axis, 1.0, { 7, 8, 9 }), 0.9, 1.5 },
    { meam::turnAbout(axis, 2.0, { 7, 8, 9 }), 0.8, 2.5 } };
  return model;
}

std::string errorOfReading(const files::Folder& folder, const std::string& bytes)
{
  const std::string path = folder.write("damaged.meam", bytes);
  const std::string error = files::errorOf([&] { meam::readModel(path); });
  EXPECT_TRUE(files::contains(error, path)) << error;
  return error;
}
}

TEST(ModelFile, ComesBackBitByBit)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  for (const meam::TrainedModel& model :
    { scenes::bracket(), scenes::bracket(meam::Preset::Paper), symmetricBracket() })
  {
    meam::writeModel(path, model);
    expectSame(meam::readModel(path), model);
  }
}

TEST(ModelFile, FindsTheSamePoses)
{
  const files::Folder folder;
  meam::writeModel(folder.path("model.meam"), scenes::bracket());
  const meam::TrainedModel read = meam::readModel(folder.path("model.meam"));
  const scenes::Seen scene = scenes::seenFromAbove(scenes::threeCopies());
  const auto settings = meam::detectionSettings(meam::Preset::Recommended, 0);
  const meam::Poses poses = scenes::estimatePoses(scenes::bracket(), scene, settings);
  const meam::Poses again = scenes::estimatePoses(read, scene, settings);
  ASSERT_EQ(poses.size(), again.size());
  ASSERT_GE(poses.size(), 3u);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    EXPECT_EQ(poses[i].T_scene_model.matrix(), again[i].T_scene_model.matrix()) << i;
    EXPECT_EQ(poses[i].probability, again[i].probability) << i;
  }
}

TEST(ModelFile, AModelWithoutSurface)
{
  const files::Folder folder;
  meam::TrainedModel model = scenes::bracket();
  model.surface = {};
  meam::writeModel(folder.path("model.meam"), model);
  EXPECT_TRUE(meam::readModel(folder.path("model.meam")).surface.empty());
}

TEST(ModelFile, WhatIsWrongWithAFile)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  meam::writeModel(path, scenes::bracket());
  EXPECT_TRUE(meam::isModel(path));
  const std::string whole = meam::readFile(path);

  EXPECT_TRUE(files::contains(errorOfReading(folder, ""), "not a trained model"));
  EXPECT_TRUE(files::contains(errorOfReading(folder, "solid part\nendsolid part\n"), "not a trained model"));
  EXPECT_FALSE(meam::isModel(folder.path("damaged.meam")));
  EXPECT_FALSE(meam::isModel(folder.path("missing.meam")));
  std::string text = whole; // as a transfer of text changes it
  text.erase(text.find('\r'), 1);
  EXPECT_TRUE(files::contains(errorOfReading(folder, text), "as if it were text"));
  std::string older = whole;
  older[8] = 2;
  EXPECT_TRUE(files::contains(errorOfReading(folder, older), "version 2"));
  EXPECT_TRUE(files::contains(errorOfReading(folder, older), "train the model again"));
  for (const std::size_t length : { std::size_t(12), std::size_t(14), whole.size() / 2, whole.size() - 1 })
  {
    EXPECT_TRUE(files::contains(errorOfReading(folder, whole.substr(0, length)), "cut off")) << length;
  }
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  EXPECT_TRUE(files::contains(errorOfReading(folder, flipped), "damaged"));
  EXPECT_TRUE(files::contains(
    files::errorOf([&] { meam::readModel(folder.path("missing.meam")); }), folder.path("missing.meam")));
  EXPECT_TRUE(files::contains(
    files::errorOf([&] { meam::writeModel(folder.path("no/folder.meam"), scenes::bracket()); }), "cannot be written"));
}

TEST(ModelFile, AModelThatIsNotSoundIsNotWritten)
{
  const files::Folder folder;
  const std::vector<std::pair<std::string, std::function<void(meam::TrainedModel&)>>> damages = {
    { "diameter", [](auto& model) { model.diameter = 0.0; } },
    { "diameter", [](auto& model) { model.diameter = NAN; } },
    { "diameter", [](auto& model) { model.diameter = 1e-45; } },
    { "farther apart", [](auto& model) { model.diameter = 1.0; } },
    { "farther apart", [](auto& model) { model.surface.points[0].x() = 1e6f; } },
    { "step", [](auto& model) { model.settings.distanceStep = 1.5; } },
    { "step", [](auto& model) { model.settings.angleStep = NAN; } },
    { "too small", [](auto& model) { model.settings.distanceStep = 1e-9; } },
    { "leaf size", [](auto& model) { model.settings.leafSize = NAN; } },
    { "no edge points", [](auto& model) { model.edges = {}; } },
    { "no edge points", [](auto& model) { model.edges.tangents.pop_back(); } },
    { "not every edge point", [](auto& model) { model.edgeVisible.pop_back(); } },
    { "not numbers", [](auto& model) { model.edges.points[3].y() = NAN; } },
    { "not numbers", [](auto& model) { model.edges.tangents[3].z() = INFINITY; } },
    { "views", [](auto& model) { model.viewDirections.clear(); } },
    { "unit vectors", [](auto& model) { model.viewDirections[1] *= 2.0f; } },
    { "view that does not exist", [](auto& model) { model.edgeViews[5] = 1u << 31; } },
    { "view that does not exist", [](auto& model) { model.edgeViews[5] = 0; } },
    { "without normals", [](auto& model) { model.surface.normals.pop_back(); } },
    { "not numbers", [](auto& model) { model.surface.normals[2].x() = NAN; } },
    { "symmetries", [](auto& model) { model.symmetries.discrete = { Eigen::Isometry3d(Eigen::Matrix4d::Zero()) }; } },
    { "symmetries",
      [](auto& model) {
        model.symmetries.continuous = { { { 0, 0, 2 }, { 0, 0, 0 } } };
      } },
    { "symmetries",
      [](auto& model) {
        model.symmetries.near = { { Eigen::Isometry3d::Identity(), NAN, 0.0 } };
      } },
    { "pair table", [](auto& model) { model.table.offsets.pop_back(); } },
    { "pair table", [](auto& model) { model.table.offsets[1] = 4000000000u; } },
    { "pair table", [](auto& model) { model.table.references[7] = 4000000000u; } },
    { "pair table", [](auto& model) { model.table.referreds[7] = 4000000000u; } },
    { "pair table", [](auto& model) { model.table.angles[7] = NAN; } },
    { "pair table", [](auto& model) { model.table.viewBits.pop_back(); } },
    { "surface points", [](auto& model) { model.surfaceTable.offsets.pop_back(); } },
    { "surface points", [](auto& model) { model.surfaceTable.references[7] = 4000000000u; } },
    { "surface points", [](auto& model) { model.surfacePairPoints.normals.pop_back(); } },
    { "not numbers", [](auto& model) { model.surfacePairPoints.points[0].x() = NAN; } },
    { "surface points", [](auto& model) { model.settings.surface.leafSize = 0.0; } },
    { "surface points", [](auto& model) { model.settings.surface.angleStep = NAN; } },
  };
  int number = 0;
  for (const auto& [words, damage] : damages)
  {
    meam::TrainedModel model = scenes::bracket();
    damage(model);
    const std::string error = files::errorOf([&] { meam::writeModel(folder.path("model.meam"), model); });
    EXPECT_TRUE(files::contains(error, words)) << number << ": " << error;
    EXPECT_TRUE(files::contains(error, "Train the model again")) << number << ": " << error;
    EXPECT_FALSE(std::filesystem::exists(folder.path("model.meam"))) << number;
    ++number;
  }
}
