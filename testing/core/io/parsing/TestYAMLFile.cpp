// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/YAMLFile.h"
#include "TestFiles.h"

#include <nlohmann/json.hpp>

namespace
{
std::string parsed(const std::string& text) { return meam::parseYAML("a.yaml", text).dump(); }

const files::Reader parseFile{ [](const std::string& path) { return meam::parseYAML(path, meam::readFile(path)); } };
}

TEST(YAMLFile, becomesJSON)
{
  EXPECT_EQ(
    parsed(
      "a: 1\nb:\n  c: -2.5e1 # here\n  d:\n    e: +3.\ng: text\nh:\n- x: 5\n  y: []\n- x: {z: 7}\ni:\n---\nj: 1\n"),
    R"({"a":1.0,"b":{"c":-25.0,"d":{"e":3.0}},"g":"text","h":[{"x":5.0,"y":[]},{"x":{"z":7.0}}],"i":null})");
  EXPECT_EQ(parsed("[\"1\", .Nan, nan, inf, 1e999, [2]]"), R"(["1",".Nan","nan","inf","1e999",[2.0]])");
  EXPECT_EQ(parsed(""), "null");
}

TEST(YAMLFile, ofOpenCV)
{
  const std::string matrix = "m: !!opencv-matrix\n   rows: 1\n   dt: d\n   data: [ 1., 2.5e+00,\n       -3. ]\n";
  const std::string json = R"({"m":{"data":[1.0,2.5,-3.0],"dt":"d","rows":1.0}})";
  EXPECT_EQ(parsed("%YAML:1.0\n---\n" + matrix), json);
  EXPECT_EQ(parsed("%YAML:1.0\n" + matrix), json) << "before OpenCV 3";
  EXPECT_EQ(parsed("%YAML 1.0\n---\n" + matrix + "...\n"), json);
}

TEST(YAMLFile, damaged)
{
  parseFile.fails("a: 1\nb: [ 1, 2", "line");
  parseFile.fails("a: 1\n b: 2\n", "line 2");
  parseFile.fails("a: &x 1\nb: *x\n", "has an alias in line 2, which is not read: write there what it stands for.");
  parseFile.fails("fx: 1\nk: {fx: 2}\nfx: 3\n", "has the key 'fx' twice in one object: leave the one that counts.");
  parseFile.fails("? [1]\n: 2\n", "no name");
  parseFile.fails(std::string(100, '[') + std::string(100, ']'), "lists in lists");
  std::string nested;
  for (int k = 0; k < 100; ++k)
  {
    nested += "- ";
  }
  parseFile.fails(nested, "lists in lists");
}
