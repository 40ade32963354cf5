// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "io/ModelsInfo.h"

#include <cmath>

namespace
{
/// Of object 1.
const files::Reader readInfo{ [](const std::string& path) { return meam::readModelsInfo(path, 1); },
  "models_info.json" };
}

TEST(ModelsInfo, writtenIsReadAgain)
{
  meam::Symmetries symmetries;
  symmetries.discrete = { meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI, { 0, 2, 3 }) };
  symmetries.continuous = { { Eigen::Vector3d(0, 0.6, 0.8), Eigen::Vector3d(1, 2, 3) } };
  Eigen::AlignedBox3f box(Eigen::Vector3f(-1, -2, -3), Eigen::Vector3f(1, 2, 3));
  const files::Folder folder;
  const std::string path =
    folder.write("models_info.json", "{ \"7\": " + meam::modelsInfo(symmetries, 12.5, box) + " }");
  const meam::Symmetries again = meam::readModelsInfo(path, 7);
  ASSERT_EQ(again.discrete.size(), 1u);
  EXPECT_TRUE(again.discrete[0].isApprox(symmetries.discrete[0]));
  ASSERT_EQ(again.continuous.size(), 1u);
  EXPECT_TRUE(again.continuous[0].axis.isApprox(symmetries.continuous[0].axis));
  EXPECT_EQ(again.continuous[0].point, symmetries.continuous[0].point);
  EXPECT_TRUE(again.near.empty());
}

TEST(ModelsInfo, whatIsNotThereIsNoSymmetry)
{
  EXPECT_FALSE(readInfo(R"({ "1": { "diameter": 5 } })").exact());
  EXPECT_FALSE(readInfo(R"({ "1": { "symmetries_discrete": [[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]] } })").exact());
  const auto turn = readInfo(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 5], "offset": [1, 0, 0] }] } })");
  EXPECT_EQ(turn.continuous.at(0).axis, Eigen::Vector3d(0, 0, 1));
}

TEST(ModelsInfo, badFiles)
{
  EXPECT_THROW(meam::readModelsInfo("/no/such/models_info.json", 1), meam::Error);
  readInfo.fails("{", "not JSON");
  readInfo.fails("[]", "no object 1");
  readInfo.fails(std::string(300000, '[') + std::string(300000, ']'), "lists in lists");
  readInfo.fails(R"({ "2": {} })", "no object 1");
  readInfo.fails(R"({ "1": 5 })", "no object 1");
  readInfo.fails(R"({ "1": { "symmetries_discrete": 5 } })", "not a list");
  readInfo.fails(R"({ "1": { "symmetries_discrete": [[1, 2, 3]] } })", "4x4 matrix");
  readInfo.fails(R"({ "1": { "symmetries_discrete": [["a"]] } })", "not made of numbers");
  readInfo.fails(R"({ "1": { "symmetries_discrete": [[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]] } })", "4x4 matrix");
  readInfo.fails(R"({ "1": { "symmetries_continuous": [[0, 0, 1]] } })", "three numbers as axis");
  readInfo.fails(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 1] }] } })", "three numbers as offset");
  readInfo.fails(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 0], "offset": [0, 0, 0] }] } })", "direction");
}
