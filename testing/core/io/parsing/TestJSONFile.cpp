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
