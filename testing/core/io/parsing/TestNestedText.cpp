// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/NestedText.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using meam::NestedNumbers;

TEST(NestedText, indentedText)
{
  const NestedNumbers found = meam::numbersInIndentedText("a: 1\nb:\n  c: -2.5e1 # here\n  d:\n    e: 3\n  f: 4\n"
                                                          "g: text\nh:\n- x: 5\n  y: 6\n- x: 7\ni: 8\n---\n");
  EXPECT_EQ(found, (NestedNumbers{ { "a", 1 }, { "b.c", -25 }, { "b.d.e", 3 }, { "b.f", 4 }, { "h.0.x", 5 },
                     { "h.0.y", 6 }, { "h.1.x", 7 }, { "i", 8 } }));
  EXPECT_EQ(meam::numbersInIndentedText("- x: 1\n- x: 2\n"), (NestedNumbers{ { "0.x", 1 }, { "1.x", 2 } }));
  EXPECT_TRUE(meam::numbersInIndentedText("- \n-\n:\n").empty());
}

TEST(NestedText, json)
{
  EXPECT_EQ(meam::numbersInJSONTree(nlohmann::json::parse(R"({"a": 1, "b": {"c": [2, {"d": 3}], "e": "text"}})")),
    (NestedNumbers{ { "a", 1 }, { "b.c.0", 2 }, { "b.c.1.d", 3 } }));
}

TEST(NestedText, namesAreOfALimitedLength)
{
  // Otherwise each number would take as much memory as the whole file.
  const std::string name(300, 'n');
  EXPECT_EQ(meam::numbersInJSONTree({ { name, { 1, 2 } }, { "a", { 3 } } }), (NestedNumbers{ { "a.0", 3 } }));
  EXPECT_EQ(
    meam::numbersInIndentedText(name + ":\n  b: 1\n" + name + ": 2\na:\n  b: 3\n"), (NestedNumbers{ { "a.b", 3 } }));
}
