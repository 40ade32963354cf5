// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "io/ModelsInfo.h"

#include <cmath>

namespace
{
meam::Symmetries read(const std::string& text, int objectId = 1)
{
  const files::Folder folder;
  return meam::readModelsInfo(folder.write("models_info.json", text), objectId);
}

void expectError(const std::string& text, const std::string& word)
{
  const files::Folder folder;
  const std::string path = folder.write("models_info.json", text);
  const std::string error = files::errorOf([&] { meam::readModelsInfo(path, 1); });
  EXPECT_TRUE(files::contains(error, word) && files::contains(error, path))
    << text.substr(0, 200) << "\nsays: " << error;
}
}

TEST(ModelsInfo, writtenIsReadAgain)
{
  meam::Symmetries symmetries;
  symmetries.discrete = { meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI, { 0, 2, 3 }) };
  symmetries.continuous = { { Eigen::Vector3d(0, 0.6, 0.8), Eigen::Vector3d(1, 2, 3) } };
  Eigen::AlignedBox3f box(Eigen::Vector3f(-1, -2, -3), Eigen::Vector3f(1, 2, 3));
  const meam::Symmetries again = read("{ \"7\": " + meam::modelsInfo(symmetries, 12.5, box) + " }", 7);
  ASSERT_EQ(again.discrete.size(), 1u);
  EXPECT_TRUE(again.discrete[0].isApprox(symmetries.discrete[0]));
  ASSERT_EQ(again.continuous.size(), 1u);
  EXPECT_TRUE(again.continuous[0].axis.isApprox(symmetries.continuous[0].axis));
  EXPECT_EQ(again.continuous[0].point, symmetries.continuous[0].point);
  EXPECT_TRUE(again.near.empty());
}

TEST(ModelsInfo, whatIsNotThereIsNoSymmetry)
{
  EXPECT_FALSE(read(R"({ "1": { "diameter": 5 } })").exact());
  EXPECT_FALSE(read(R"({ "1": { "symmetries_discrete": [[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]] } })").exact());
  const auto turn = read(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 5], "offset": [1, 0, 0] }] } })");
  EXPECT_EQ(turn.continuous.at(0).axis, Eigen::Vector3d(0, 0, 1));
}

TEST(ModelsInfo, badFiles)
{
  EXPECT_THROW(meam::readModelsInfo("/no/such/models_info.json", 1), meam::Error);
  expectError("{", "not JSON");
  expectError("[]", "no object 1");
  expectError(std::string(300000, '[') + std::string(300000, ']'), "lists in lists");
  expectError(R"({ "2": {} })", "no object 1");
  expectError(R"({ "1": 5 })", "no object 1");
  expectError(R"({ "1": { "symmetries_discrete": 5 } })", "not a list");
  expectError(R"({ "1": { "symmetries_discrete": [[1, 2, 3]] } })", "4x4 matrix");
  expectError(R"({ "1": { "symmetries_discrete": [["a"]] } })", "not made of numbers");
  expectError(R"({ "1": { "symmetries_discrete": [[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]] } })", "4x4 matrix");
  expectError(R"({ "1": { "symmetries_continuous": [[0, 0, 1]] } })", "three numbers as axis");
  expectError(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 1] }] } })", "three numbers as offset");
  expectError(R"({ "1": { "symmetries_continuous": [{ "axis": [0, 0, 0], "offset": [0, 0, 0] }] } })", "direction");
}
