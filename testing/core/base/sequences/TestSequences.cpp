// SPDX-License-Identifier: BSD-3-Clause
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

using Values = std::vector<int>;

TEST(Sequences, OneValueOfEachElementOrIndexInTheirOrder)
{
  EXPECT_EQ(meam::mapped<int>(Values{ 3, 1, 2 }, [](int value) { return 10 * value; }), (Values{ 30, 10, 20 }));
  EXPECT_EQ(meam::ofIndices<int>(3, [](int index) { return index * index; }), (Values{ 0, 1, 4 }));
  EXPECT_TRUE(meam::mapped<int>(Values{}, [](int value) { return value; }).empty());
}

TEST(Sequences, SomeAreChosenAndSummedUp)
{
  const auto isOdd = [](int value) { return value % 2 == 1; };
  EXPECT_EQ(meam::indicesWhere(6, isOdd), (Values{ 1, 3, 5 }));
  Values values{ 3, 1, 2, 4 };
  EXPECT_EQ(meam::sumOf(values, [](int value) { return 0.5 * value; }), 5.0);
  meam::eraseIf(values, isOdd);
  EXPECT_EQ(values, (Values{ 2, 4 }));
}
