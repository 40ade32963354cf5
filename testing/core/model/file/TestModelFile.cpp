// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/ModelFile.h"

#include "base/Frames.h"
#include "model/body/BodyInterior.h"

#include "TestFiles.h"
#include "TestScene.h"

#include <functional>

namespace
{
meam::TriangleMesh handedPart() { return parts::blockOnPlate(false); }
meam::TriangleMesh plainBox() { return parts::box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 15.0f }); }

/// The matrices of transforms one after the other.
std::vector<double> numbersOf(const std::vector<Eigen::Isometry3d>& transforms)
{
  std::vector<double> numbers;
  for (const auto& T : transforms)
  {
    meam::appendNumbersOf(T, numbers);
  }
  return numbers;
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
  EXPECT_EQ(numbersOf(a.symmetries.discrete), numbersOf(b.symmetries.discrete));
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

}

TEST(ModelFile, ComesBackBitByBit)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  meam::TrainedModel bare = scenes::bracket();
  bare.surface = {};
  for (const meam::TrainedModel& model :
    { scenes::bracket(), scenes::bracket(meam::Preset::Paper), symmetricBracket(), bare })
  {
    meam::writeModel(path, model);
    expectSame(meam::readModel(path), model);
  }
}

TEST(ModelFile, HoldsWhatDetectionDerives)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  const meam::TrainedModel& model = scenes::trained<parts::tower>();
  meam::writeModel(path, model);
  const meam::TrainedModel read = meam::readModel(path);
  for (const auto field : { &meam::TrainedModel::surfaceDistance, &meam::TrainedModel::edgeDistance })
  {
    const meam::DistanceField::Stored stored = (model.*field).stored();
    EXPECT_GT(stored.distances.size(), 1000u);
    EXPECT_EQ((read.*field).stored().frame, stored.frame);
    EXPECT_EQ((read.*field).stored().size, stored.size);
    EXPECT_EQ((read.*field).stored().distances, stored.distances);
    for (const Eigen::Vector3f& point : model.surface.points)
    {
      EXPECT_EQ((read.*field).at(point), (model.*field).at(point));
    }
  }
  EXPECT_EQ(read.interior->cells(), model.interior->cells());
  EXPECT_EQ(read.table.votes, model.table.votes);
  EXPECT_EQ(read.verificationPoints, model.verificationPoints);
  const std::vector<meam::SideSymmetry>& sides = model.sides->of(model);
  ASSERT_FALSE(sides.empty());
  ASSERT_EQ(read.sides->of(read).size(), sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    EXPECT_EQ(read.sides->of(read)[k].towards, sides[k].towards);
    EXPECT_EQ(numbersOf(read.sides->of(read)[k].turns), numbersOf(sides[k].turns));
  }
}

TEST(ModelFile, HoldsHowAPartIsMirrored)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  const meam::TrainedModel& handed = scenes::trained<handedPart>();
  meam::writeModel(path, handed);
  const meam::TrainedModel read = meam::readModel(path);
  const meam::MirroredPart* mirrored = handed.mirrorImage->of(handed);
  ASSERT_NE(mirrored, nullptr);
  ASSERT_NE(read.mirrorImage->of(read), nullptr);
  EXPECT_EQ(read.mirrorImage->of(read)->model.surface.points, mirrored->model.surface.points);
  EXPECT_EQ(numbersOf(read.mirrorImage->of(read)->turns), numbersOf(mirrored->turns));
  const meam::TrainedModel& plain = scenes::trained<plainBox>();
  meam::writeModel(path, plain);
  const meam::TrainedModel readPlain = meam::readModel(path);
  EXPECT_EQ(readPlain.mirrorImage->of(readPlain), nullptr) << "its own mirror image";
}

TEST(ModelFile, WhatIsWrongWithAFile)
{
  const files::Folder folder;
  const std::string path = folder.path("model.meam");
  meam::writeModel(path, scenes::bracket());
  EXPECT_TRUE(meam::isModel(path));
  const std::string whole = meam::readFile(path);
  const auto changed = [&](std::size_t at, char value)
  {
    std::string bytes = whole;
    bytes[at] = value;
    return bytes;
  };
  const files::Reader read{ [](const std::string& file) { return meam::readModel(file); }, "damaged.meam" };
  read.fails("", "not a trained model");
  read.fails("solid part\nendsolid part\n", "not a trained model");
  read.fails(std::string(whole).erase(whole.find('\r'), 1), "as if it were text"); // as a transfer of text changes it
  read.fails(changed(8, 2), "version 2");
  read.fails(changed(8, 2), "train the model again");
  for (const std::size_t length : { std::size_t(12), std::size_t(14), whole.size() / 2, whole.size() - 1 })
  {
    read.fails(whole.substr(0, length), "cut off");
  }
  read.fails(changed(whole.size() / 2, whole[whole.size() / 2] ^ 1), "damaged");
  const std::string missing = folder.path("missing.meam");
  EXPECT_FALSE(meam::isModel(missing));
  EXPECT_FALSE(meam::isModel(folder.write("part.stl", "solid part\nendsolid part\n")));
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readModel(missing); }), missing));
  EXPECT_TRUE(files::contains(
    files::errorOf([&] { meam::writeModel(folder.path("no/folder.meam"), scenes::bracket()); }), "cannot be written"));
}

TEST(ModelFile, AModelThatIsNotSoundIsNotWritten)
{
  const files::Folder folder;
  meam::TrainedModel model = scenes::bracket();
  model.diameter = 0.0; // TestModelValidation has all other ways
  const std::string error = files::errorOf([&] { meam::writeModel(folder.path("model.meam"), model); });
  EXPECT_TRUE(files::contains(error, "diameter") && files::contains(error, "Train the model again")) << error;
  EXPECT_FALSE(std::filesystem::exists(folder.path("model.meam")));
}
