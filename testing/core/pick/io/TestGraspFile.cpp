// SPDX-License-Identifier: BSD-3-Clause
#include "pick/io/GraspFile.h"
#include "TestFiles.h"

namespace
{
using files::Folder;

/// A file with grasps as they are given, separated by commas.
std::string file(const std::string& grasps)
{
  return R"({"format": "meam-grasps", "version": 1, "units": "mm", "grasps": [)" + grasps + "]}";
}

const std::string Jaws =
  R"({"name": "side", "kind": "parallel", "position": [1, 2, 3], "approach": [0, 0, -2], "closing": [5, 0, 1], "width": 20})";
const std::string Cup = R"({"kind": "suction", "position": [0, 0, 5], "approach": [0, 0, -1]})";

meam::Grasps read(const std::string& text)
{
  const Folder folder;
  return meam::readGrasps(folder.write("part.grasps.json", text));
}

/// What reading says; empty when it is fine.
std::string errorOf(const std::string& text)
{
  return files::errorOf([&] { read(text); });
}

/// The grasp of jaws with one entry instead of another.
std::string jawsWith(const std::string& from, const std::string& to)
{
  std::string text = Jaws;
  return file(text.replace(text.find(from), from.size(), to));
}
}

TEST(GraspFile, directionsBecomeAFrame)
{
  const meam::Grasps grasps = read(file(Jaws));
  ASSERT_EQ(grasps.size(), 1u);
  EXPECT_EQ(grasps[0].name, "side");
  EXPECT_EQ(grasps[0].kind, meam::GraspKind::Parallel);
  EXPECT_EQ(grasps[0].width, 20.0);
  EXPECT_EQ(grasps[0].freeTurn, meam::FreeTurn::None);
  EXPECT_EQ(grasps[0].quality, 1.0);
  Eigen::Matrix4d expected;
  expected << 1, 0, 0, 1, 0, -1, 0, 2, 0, 0, -1, 3, 0, 0, 0, 1;
  EXPECT_TRUE(grasps[0].T_model_grasp.matrix().isApprox(expected, 1e-15));
}

TEST(GraspFile, aCupNeedsLess)
{
  const meam::Grasps grasps = read(file(Jaws + "," + Cup));
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[1].name, "grasp 2");
  EXPECT_EQ(grasps[1].kind, meam::GraspKind::Suction);
  EXPECT_EQ(grasps[1].freeTurn, meam::FreeTurn::Approach);
  EXPECT_EQ(grasps[1].T_model_grasp.linear().col(2), Eigen::Vector3d(0, 0, -1));
  EXPECT_TRUE(read(file("")).empty());
}

TEST(GraspFile, whatIsWrittenIsReadAgain)
{
  meam::Grasp disc;
  disc.name = "disc \"A\"";
  disc.T_model_grasp = meam::graspFrame({ 0.1, -2.5, 1.0 / 3.0 }, { 1, 2, 3 }, { 3, 0, -1 });
  disc.width = 1.0 / 7.0;
  disc.freeTurn = meam::FreeTurn::Closing;
  disc.quality = 0.1;
  meam::Grasp cup;
  cup.name = "cup";
  cup.kind = meam::GraspKind::Suction;
  const Folder folder;
  const std::string path = folder.path("part.grasps.json");
  meam::writeGrasps(path, { disc, cup });
  const meam::Grasps grasps = meam::readGrasps(path);
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0].name, disc.name);
  EXPECT_EQ(grasps[0].width, disc.width);
  EXPECT_EQ(grasps[0].freeTurn, disc.freeTurn);
  EXPECT_EQ(grasps[0].quality, disc.quality);
  EXPECT_EQ(grasps[0].T_model_grasp.translation(), disc.T_model_grasp.translation());
  EXPECT_TRUE(grasps[0].T_model_grasp.isApprox(disc.T_model_grasp, 1e-15));
  EXPECT_EQ(grasps[1].kind, cup.kind);
  EXPECT_EQ(grasps[1].freeTurn, meam::FreeTurn::None);
  EXPECT_EQ(grasps[1].T_model_grasp.matrix(), cup.T_model_grasp.matrix());
  meam::writeGrasps(path, {});
  EXPECT_TRUE(meam::readGrasps(path).empty());
}

TEST(GraspFile, errorsNameTheFileTheGraspAndTheEntry)
{
  const std::pair<const char*, std::pair<const char*, const char*>> cases[] = {
    { "'position'", { "[1, 2, 3]", "[1, 2]" } },
    { "'position'", { "[1, 2, 3]", "[1, 2, \"3\"]" } },
    { "'approach'", { "[0, 0, -2]", "[0, 0, 0]" } },
    { "'closing'", { "[5, 0, 1]", "[0, 0, 1]" } },
    { "'width'", { ", \"width\": 20", "" } },
    { "'width'", { "20", "\"wide\"" } },
    { "width", { "20", "-1" } },
    { "'kind'", { "\"parallel\"", "\"magnet\"" } },
    { "'free_turn'", { "20", "20, \"free_turn\": \"any\"" } },
    { "quality", { "20", "20, \"quality\": 1.5" } },
    { "'free_trun'", { "20", "20, \"free_trun\": \"none\"" } },
  };
  for (const auto& [entry, change] : cases)
  {
    const std::string error = errorOf(jawsWith(change.first, change.second));
    EXPECT_TRUE(files::contains(error, "part.grasps.json")) << change.second << ": " << error;
    EXPECT_TRUE(files::contains(error, "'side'")) << change.second << ": " << error;
    EXPECT_TRUE(files::contains(error, entry)) << change.second << ": " << error;
  }
  EXPECT_TRUE(files::contains(errorOf(jawsWith("\"side\"", "5")), "'grasp 1' has a 'name'"));
  EXPECT_TRUE(files::contains(errorOf(file(Jaws + ", 7")), "'grasp 2' is not an object"));
  EXPECT_TRUE(files::contains(errorOf(file(Jaws + "," + Jaws)), "two grasps with the 'name' 'side'"));
}

TEST(GraspFile, otherFilesAreRefused)
{
  EXPECT_TRUE(files::contains(errorOf("{\"poses\": []}"), "'format'"));
  EXPECT_TRUE(files::contains(errorOf("[]"), "'format'"));
  EXPECT_TRUE(files::contains(errorOf(R"({"format": "meam-grasps", "version": 2})"), "'version'"));
  EXPECT_TRUE(files::contains(errorOf(R"({"format": "meam-grasps", "version": 1, "units": "m"})"), "'units'"));
  EXPECT_TRUE(files::contains(errorOf(R"({"format": "meam-grasps", "version": 1, "units": "mm"})"), "'grasps'"));
  EXPECT_TRUE(files::contains(errorOf("{\"format\": "), "not JSON"));
  EXPECT_THROW(meam::readGrasps("/no/such/file.json"), meam::Error);
}

TEST(GraspFile, whatCannotBeReadIsNotWritten)
{
  const Folder folder;
  const std::string path = folder.write("part.grasps.json", "old");
  meam::Grasp bad;
  bad.quality = 2.0;
  EXPECT_THROW(meam::writeGrasps(path, { bad }), meam::Error);
  EXPECT_THROW(meam::writeGrasps(path, { {}, {} }), meam::Error); // one name
  EXPECT_EQ(meam::readFile(path), "old");
}
