// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/DerivedFields.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/NamedArrays.h"

#include "TestScene.h"

#include <cmath>

namespace
{
/// What the file of a part holds, after some of it was changed.
template <typename Change>
std::optional<meam::DerivedFields> derivedAfter(Change&& change)
{
  const meam::TrainedModel& model = scenes::trained<parts::tower>();
  meam::NamedArrays arrays;
  setDerived(arrays, model);
  change(arrays);
  return derivedOf(arrays);
}
}

TEST(DerivedFields, ComeBack)
{
  const auto derived = derivedAfter([](meam::NamedArrays&) {});
  ASSERT_TRUE(derived);
  const meam::TrainedModel& model = scenes::trained<parts::tower>();
  EXPECT_EQ(derived->surfaceDistance.stored().distances, model.surfaceDistance.stored().distances);
  EXPECT_EQ(derived->edgeDistance.stored().distances, model.edgeDistance.stored().distances);
  EXPECT_FALSE(derived->sides.empty());
}

TEST(DerivedFields, OfAnotherVersionAndOfNoneThereAreNone)
{
  EXPECT_FALSE(meam::derivedOf(meam::NamedArrays()));
  EXPECT_FALSE(derivedAfter([](auto& arrays) { arrays.set("DerivedVersion", std::vector<std::int32_t>{ 0 }); }));
}

TEST(DerivedFields, WhatIsNotSoundIsDamaged)
{
  const auto expectDamaged = [](auto&& change) { EXPECT_THROW(derivedAfter(change), meam::Error); };
  using Arrays = meam::NamedArrays;
  for (const char* field : { "SurfaceField", "EdgeField" })
  {
    const std::string name = field;
    expectDamaged([&](Arrays& arrays) { arrays.set(name + "Frame", std::vector<float>(8)); });
    expectDamaged([&](Arrays& arrays) { arrays.set(name + "Frame", std::vector<float>(9, NAN)); });
    expectDamaged([&](Arrays& arrays) { arrays.set(name + "Size", std::vector<std::int32_t>{ 1, 2 }); });
    expectDamaged([&](Arrays& arrays) { arrays.set(name + "Size", std::vector<std::int32_t>{ -1, -1, 1 }); });
    expectDamaged(
      [&](Arrays& arrays) {
        arrays.set(name + "Size", std::vector<std::int32_t>{ 1 << 30, 1 << 30, 16 });
      });
    expectDamaged([&](Arrays& arrays) { arrays.set(name + "Cells", std::vector<std::uint8_t>(10)); });
  }
  expectDamaged([](Arrays& arrays) { arrays.set("MirrorPlane", meam::Points()); });
  expectDamaged([](Arrays& arrays) { arrays.set("MirrorPlane", meam::Points(2, Eigen::Vector3f(2, 0, 0))); });
  expectDamaged([](Arrays& arrays) { arrays.set("MirrorTurns", std::vector<double>(16, 1.0)); });
  expectDamaged([](Arrays& arrays) { arrays.set("SideDirections", meam::Points(1, Eigen::Vector3f(2, 0, 0))); });
  expectDamaged([](Arrays& arrays) { arrays.set("MirrorTurns", std::vector<double>(17, 1.0)); });
  expectDamaged([](Arrays& arrays) { arrays.set("SideTurnCounts", std::vector<std::int32_t>(20, 1000)); });
  expectDamaged([](Arrays& arrays) { arrays.set("SideTurnCounts", std::vector<std::int32_t>(1, -1)); });
  expectDamaged([](Arrays& arrays) { arrays.set("SideTurnCounts", std::vector<std::int32_t>()); });
}
