// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/JSONFile.h"

#include "TestFiles.h"
#include "calibration/HandEyeFile.h"
#include "io/ModelsInfo.h"

#include <nlohmann/json.hpp>

TEST(JSONFile, whatIsNestedWithoutEndIsRefused)
{
  const files::Folder folder;
  const auto nested = [](int levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_TRUE(meam::parseJSON("a.json", nested(60)).is_array());
  // Copies of these would need more than the whole stack.
  const std::string deep = nested(1000000);
  const auto expectRefused = [](const std::string& error)
  { EXPECT_TRUE(files::contains(error, "lists in lists 64 times over")) << error; };
  const std::string info = folder.write("a.json", R"({"1": {"symmetries_discrete": )" + deep + "}}");
  expectRefused(files::errorOf([&] { meam::readModelsInfo(info, 1); }));
  const std::string pairs = folder.write("b.json", R"({"pairs": [], "units": )" + deep + "}");
  expectRefused(files::errorOf([&] { meam::readHandEye(pairs); }));
}

TEST(JSONFile, aKeyTwiceIsRefused)
{
  const auto errorOf = [](const std::string& text) { return files::errorOf([&] { meam::parseJSON("a.json", text); }); };
  EXPECT_EQ(meam::parseJSON("a.json", R"([{"fx": {"fx": 1}, "fy": 2}, {"fx": 3}])").size(), 2u);
  EXPECT_TRUE(files::contains(errorOf(R"({"fx": 1, "fy": [{"a": 1}], "fx": 2})"), "has the key 'fx' twice"));
  EXPECT_TRUE(files::contains(errorOf(R"([{"": 1, "": 2}])"), "has the key '' twice"));
  EXPECT_TRUE(files::contains(errorOf(R"({"fx": 1, "fy": 2)"), "is not JSON"));
}

TEST(JSONFile, bracketsInTextsAreNotNested)
{
  const std::string brackets(100, '[');
  const std::string text = R"(a\"b\\)" + brackets; // a quote and a backslash that are escaped
  EXPECT_EQ(meam::parseJSON("a.json", "[\"" + text + "\"]")[0].get<std::string>(), "a\"b\\" + brackets);
}

// Their time once grew with the square of their number: minutes, which the test's time limit ends.
TEST(JSONFile, readsManyObjectsOfAList)
{
  std::string text = "[{}";
  for (int i = 1; i < 200000; ++i)
  {
    text += ",{}";
  }
  EXPECT_EQ(meam::parseJSON("a.json", text + "]").size(), 200000u);
}
