// SPDX-License-Identifier: BSD-3-Clause
#include "io/PoseFile.h"

#include "TestFiles.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace
{
/// A quarter turn about z and a shift that needs all its digits.
meam::PoseRow quarterTurn()
{
  meam::PoseRow row;
  row.T_scene_model.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  row.T_scene_model.translation() << 0.1, -2.5, 1.0 / 3.0;
  row.score = 0.75;
  return row;
}

/// The same, with what it is of.
meam::PoseRow identified()
{
  meam::PoseRow row = quarterTurn();
  row.sceneId = 3;
  row.imageId = 7;
  row.objectId = 2;
  row.time = 0.5;
  return row;
}

/// An empty folder and the path of a file in it.
struct Poses : files::Folder
{
  std::string file() const { return this->path("poses"); }
  long files() const { return std::distance(std::filesystem::directory_iterator(this->path()), {}); }
};

const files::Reader readMatrices{ meam::readMatrices };
}

TEST(PoseFile, readsBlocks)
{
  const auto poses = readMatrices("# ground truth\n0 -1 0 1.5\n1 0 0 +2\n0 0 1 -3e0\n0 0 0 1\n\n1 0 0 0 0 "
                                  "1 0 0 0 0 1 0 0 0 0 1# end");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0] * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1.5, 3, -3));
  EXPECT_TRUE(poses[1].matrix().isIdentity());
  EXPECT_TRUE(readMatrices("# nothing found\n\n").empty());
}

TEST(PoseFile, badMatrices)
{
  EXPECT_THROW(meam::readMatrices("/no/such/file.txt"), meam::Error);
  for (const char* text : { "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 5",
         "1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1", "1 0 0 x 0 1 0 0 0 0 1 0 0 0 0 1",
         "2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",  // scale
         "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", // mirror
         "1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1" })
  { // column-major
    EXPECT_THROW(readMatrices(text), meam::Error) << text;
  }
}

TEST(PoseFile, bopRows)
{
  const Poses folder;
  meam::PoseRow row = identified();
  meam::writeBOP(folder.file(), { row, {} });
  EXPECT_EQ(meam::readFile(folder.file()), "scene_id,im_id,obj_id,score,R,t,time\n"
                                           "3,7,2,0.75,0 -1 0 1 0 0 0 0 1,0.1 -2.5 0.3333333333333333,0.5\n"
                                           "0,0,1,0,1 0 0 0 1 0 0 0 1,0 0 0,-1\n");
}

TEST(PoseFile, json)
{
  const Poses folder;
  meam::PoseRow row = quarterTurn();
  row.votes = 120;
  row.viewId = 4;
  row.visibleFraction = 0.5;
  meam::writeJSON(folder.file(), { row, {} });
  const auto json = nlohmann::json::parse(meam::readFile(folder.file()));
  EXPECT_EQ(json["format"], "meam-poses");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["units"], "mm");
  ASSERT_EQ(json["poses"].size(), 2u);
  const auto& pose = json["poses"][0];
  EXPECT_EQ(pose["rank"], 1);
  EXPECT_EQ(pose["score"], 0.75);
  EXPECT_EQ(pose["votes"], 120);
  EXPECT_EQ(pose["view"], 4);
  EXPECT_EQ(pose["visible_fraction"], 0.5);
  EXPECT_EQ(pose["translation"][2].get<double>(), 1.0 / 3.0);
  EXPECT_NEAR(pose["quaternion"][2].get<double>(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(pose["quaternion"][3].get<double>(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(pose["matrix"][0], nlohmann::json({ 0.0, -1.0, 0.0, 0.1 }));
  EXPECT_EQ(pose["matrix"][3], nlohmann::json({ 0.0, 0.0, 0.0, 1.0 }));
  EXPECT_EQ(json["poses"][1]["rank"], 2);
  EXPECT_FALSE(json["poses"][1].contains("votes"));
  meam::writeJSON(folder.file(), {});
  EXPECT_TRUE(nlohmann::json::parse(meam::readFile(folder.file()))["poses"].empty());
}

TEST(PoseFile, writersLeaveTheOldFileWhenTheyFail)
{
  const Poses folder;
  meam::writeFile(folder.file(), "old");
  meam::PoseRow broken;
  broken.T_scene_model.translation().x() = std::nan("");
  EXPECT_THROW(meam::writeMatrices(folder.file(), { broken }), meam::Error);
  EXPECT_THROW(meam::writeBOP(folder.file(), { broken }), meam::Error);
  EXPECT_THROW(meam::writeJSON(folder.file(), { broken }), meam::Error);
  EXPECT_EQ(meam::readFile(folder.file()), "old");
  EXPECT_EQ(folder.files(), 1);
  EXPECT_THROW(meam::writeBOP("/no/such/folder/poses.csv", {}), meam::Error);
  EXPECT_THROW(meam::writeBOP(folder.path(), {}), meam::Error);
}

TEST(PoseFile, whatIsWrittenIsReadAgain)
{
  const Poses folder;
  meam::PoseRow row = identified();
  row.rank = 4;
  row.votes = 120;
  row.viewId = 5;
  row.visibleFraction = 0.25;
  row.placeProbability = 0.875;
  row.probability = 0.75;
  row.certainty = 0.125;
  // Scene, image, object, score and time of both forms; and what JSON has beside.
  const auto numbers = [](const meam::PoseRow& r) {
    return std::vector<double>{ 1.0 * r.sceneId, 1.0 * r.imageId, 1.0 * r.objectId, r.score, r.time };
  };
  const auto more = [](const meam::PoseRow& r)
  {
    return std::vector<double>{ 1.0 * r.rank, 1.0 * r.votes, 1.0 * r.viewId, r.visibleFraction, r.placeProbability,
      r.probability, r.certainty };
  };
  const auto again = [&](const auto& write)
  {
    write(folder.file(), std::vector<meam::PoseRow>{ row, {} });
    EXPECT_EQ(folder.files(), 1);
    const std::vector<meam::PoseRow> poses = meam::readPoses(folder.file());
    EXPECT_EQ(poses.size(), 2u);
    EXPECT_EQ(poses.at(0).T_scene_model.matrix(), row.T_scene_model.matrix());
    return poses;
  };
  std::vector<meam::PoseRow> poses = again(meam::writeBOP);
  EXPECT_EQ(numbers(poses[0]), numbers(row));
  EXPECT_EQ(poses[1].time, -1.0);
  poses = again(meam::writeJSON);
  EXPECT_EQ(numbers(poses[0]), numbers(row));
  EXPECT_EQ(more(poses[0]), more(row));
  EXPECT_TRUE(std::isnan(poses[1].probability));
  again(meam::writeMatrices);
  meam::writeBOP(folder.file(), {});
  EXPECT_TRUE(meam::readPoses(folder.file()).empty());
}

TEST(PoseFile, jsonOfOlderVersionsIsRead)
{
  const Poses folder;
  const auto read = [&](const std::string& header)
  {
    meam::writeFile(folder.file(), "{" + header + R"("poses": [{"matrix": [1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1]}]})");
    return meam::readPoses(folder.file());
  };
  EXPECT_EQ(read("").size(), 1u);
  EXPECT_EQ(read(R"("format": "meam-poses", "version": 1, )").size(), 1u);
  EXPECT_THROW(read(R"("format": "meam-poses", "version": 2, )"), meam::Error);
  EXPECT_THROW(read(R"("format": "other", )"), meam::Error);
}

TEST(PoseFile, damagedFilesAreRefused)
{
  const Poses folder;
  const std::string header = "scene_id,im_id,obj_id,score,R,t,time\n";
  for (const std::string& text :
    { header + "0,0,1,0.5,1 0 0 0 1 0 0 0 1,0 0", header + "0,0,1,0.5,1 0 0 0 1 0 0 0,0 0 0,-1",
      header + "0,0,1.5,0.5,1 0 0 0 1 0 0 0 1,0 0 0,-1", header + "0,0,1,high,1 0 0 0 1 0 0 0 1,0 0 0,-1",
      header + "0,0,1,0.5,2 0 0 0 1 0 0 0 1,0 0 0,-1", std::string("{}"), std::string("{\"poses\": [{}]}"),
      std::string("{\"poses\": [{\"matrix\": [1, 2]}]}"), std::string("{\"poses\": ["), std::string("a,b,c\n1,2,3") })
  {
    meam::writeFile(folder.file(), text);
    EXPECT_THROW(meam::readPoses(folder.file()), meam::Error) << text;
  }
}
