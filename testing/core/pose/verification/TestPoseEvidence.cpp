// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseEvidence.h"

#include "TestScene.h"
#include "base/Bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
/// 2 mm of a part of 47 mm, which lets points be 1.4 mm off.
constexpr float RibHeight = 2.0f;

template <int Width>
meam::TriangleMesh ribbedPlate()
{
  const float half = 0.5f * Width;
  return parts::prism({ { 0.0f, 0.0f }, { 20.0f, 0.0f }, { 20.0f, 6.0f }, { half, 6.0f }, { half, 6.0f + RibHeight },
                        { -half, 6.0f + RibHeight }, { -half, 6.0f }, { -20.0f, 6.0f }, { -20.0f, 0.0f } },
    25.0f);
}

/// The plate of the ribs, without one.
meam::TriangleMesh barePlate() { return parts::box({ -20.0f, 0.0f, 0.0f }, { 20.0f, 6.0f, 25.0f }); }

/// 5.6 % of its diameter.
constexpr float TileThickness = 2.4f;
meam::TriangleMesh tile() { return parts::box({ -15.0f, -15.0f, 0.0f }, { 15.0f, 15.0f, TileThickness }); }

meam::TriangleMesh sheet() { return parts::box({ -25.0f, -15.0f, 0.0f }, { 25.0f, 15.0f, 0.6f }); }

/// Of a ribbed plate taken to be where a bare one is, its upper side up.
meam::PoseEvidence onBarePlate(const meam::TrainedModel& ribbed)
{
  const Eigen::Isometry3d up(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()));
  const meam::Scene scene = scenes::alone(barePlate(), ribbed, up);
  return meam::EvidenceCollector(scene, ribbed).collect(scene.T_local_scene() * up);
}
}

TEST(PoseEvidence, TheScoreIsTheShareOfWhatNothingHidesThatIsThere)
{
  using meam::PointState;
  meam::PoseEvidence evidence;
  EXPECT_EQ(evidence.score(), 0.0);
  evidence.edges.resize(3);
  evidence.edgeStates = { PointState::Matched, PointState::Violated, PointState::Hidden };
  EXPECT_DOUBLE_EQ(evidence.score(), 0.5) << "edges alone";
  evidence.surface.resize(6);
  evidence.surfaceStates = { PointState::Matched, PointState::Matched, PointState::Violated, PointState::Turned,
    PointState::Unknown, PointState::Hidden };
  EXPECT_DOUBLE_EQ(evidence.score(), 0.4);
  evidence.surfaceStates.assign(6, PointState::Hidden);
  EXPECT_EQ(evidence.score(), 0.0);
}

TEST(PoseEvidence, CountsAddUpAndMuchOfOneThingCountsByItsLogarithm)
{
  const auto ofSurface = [](double meam::EvidenceCounts::*count, double patches)
  {
    meam::EvidenceCounts counts;
    counts.*count = patches;
    return counts.ofSurface();
  };
  using Counts = meam::EvidenceCounts;
  EXPECT_DOUBLE_EQ(ofSurface(&Counts::there, 10.0), 10.0);
  EXPECT_LT(ofSurface(&Counts::unclear, 10.0), 10.0);
  EXPECT_GT(ofSurface(&Counts::unclear, 10.0), 0.0);
  EXPECT_LT(ofSurface(&Counts::farPast, 1.0), ofSurface(&Counts::past, 1.0));
  for (const auto against : { &Counts::turned, &Counts::past, &Counts::enclosed, &Counts::unmeasured })
  {
    EXPECT_LT(ofSurface(against, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(ofSurface(against, 4.0), 4.0 * ofSurface(against, 1.0));
  }
  EXPECT_GT(ofSurface(&Counts::hidden, 400.0), 20.0 * ofSurface(&Counts::hidden, 4.0)) << "one thing hides many";

  // An edge found is twice as likely where the part is, one that is missing half as likely; an outline that ends four
  // times, one that goes on a quarter.
  const meam::EvidenceRates rates{ { 2.0 / 3.0, 1.0 / 3.0 }, { 0.8, 0.2 } };
  Counts counts;
  counts.there = 10.0;
  counts.past = 0.5;
  counts.edgesFound = 20.0;
  counts.edgesMissing = 10.0;
  EXPECT_NEAR(counts.ofEdges(rates), 0.1 * (20.0 - 10.0) * std::log(2.0), 1e-12);
  EXPECT_NEAR(counts.ofLines(rates), 16.0 * std::log1p(counts.ofEdges(rates) / 16.0), 1e-12);
  counts.ends = 600.0;
  counts.goesOn = 300.0;
  const double ofLines = counts.ofLines(rates);
  EXPECT_LT(ofLines, 0.25 * 0.7 * 300.0 * std::log(4.0));
  EXPECT_DOUBLE_EQ(counts.sum(rates), counts.ofSurface() + ofLines);
  std::swap(counts.edgesFound, counts.edgesMissing);
  std::swap(counts.ends, counts.goesOn);
  EXPECT_NEAR(counts.ofLines(rates), -ofLines, 1e-12);
  EXPECT_NEAR(counts.sum({ { 0.4, 0.4 }, { 0.7, 0.7 } }), counts.ofSurface(), 1e-12)
    << "rates that tell nothing have no say";
}

TEST(PoseEvidence, RatesOfEdgesAreThoseOfTheScan)
{
  // Of twenty candidates the surface leaves no doubt which two are right: they find nine edges of ten, the others one
  // of ten. The usual rates count as 150 edges.
  std::vector<meam::EvidenceCounts> candidates(20);
  for (std::size_t k = 0; k < candidates.size(); ++k)
  {
    const bool isRight = k == 3 || k == 11;
    candidates[k].there = isRight ? 1000.0 : 0.0;
    candidates[k].past = isRight ? 0.0 : 1000.0;
    candidates[k].edgesFound = isRight ? 900.0 : 100.0;
    candidates[k].edgesMissing = isRight ? 100.0 : 900.0;
  }
  const meam::EvidenceRates rates = meam::evidenceRates(candidates, 1.0);
  EXPECT_NEAR(rates.edges.found, (1800.0 + 150.0 * 0.75) / 2150.0, 1e-12);
  EXPECT_NEAR(rates.edges.chance, (18 * 100.0 + 150.0 * 0.3) / 18150.0, 1e-12);
  const meam::EvidenceRates usual = meam::evidenceRates({}, 1.0);
  EXPECT_DOUBLE_EQ(usual.edges.found, 0.75);
  EXPECT_DOUBLE_EQ(usual.edges.chance, 0.3);

  // Edges that are found where the part is no more often than elsewhere never speak against it.
  for (meam::EvidenceCounts& counts : candidates)
  {
    std::swap(counts.edgesFound, counts.edgesMissing);
  }
  const meam::EvidenceRates misleading = meam::evidenceRates(candidates, 1.0);
  EXPECT_GT(misleading.edges.found, misleading.edges.chance);
  EXPECT_LT(misleading.edges.found - misleading.edges.chance, 0.03);
}

TEST(PoseEvidence, TheSurfaceOfASheetTellsNoRates)
{
  // What lies flat on the floor has all of its surface there, and the edges alone tell the copies from the rest.
  std::vector<meam::EvidenceCounts> candidates(20);
  for (std::size_t k = 0; k < candidates.size(); ++k)
  {
    candidates[k].there = 80.0;
    candidates[k].edgesFound = k < 2 ? 900.0 : 100.0;
    candidates[k].edgesMissing = k < 2 ? 100.0 : 900.0;
  }
  EXPECT_LT(meam::evidenceRates(candidates, 1.0).edges.found, 0.35);
  const meam::EvidenceRates rates = meam::evidenceRates(candidates, 0.0);
  EXPECT_NEAR(rates.edges.found, (1800.0 + 150.0 * 0.75) / 2150.0, 1e-3);
  EXPECT_NEAR(rates.edges.chance, (18 * 100.0 + 150.0 * 0.3) / 18150.0, 1e-3);
}

TEST(PoseEvidence, RatesOfOutlinesAreThoseOfTheScan)
{
  // The outline of one candidate of ten ends nearly everywhere, that of the others nearly nowhere. The usual rates
  // count as 90 sides.
  std::vector<meam::EvidenceCounts> candidates(10);
  for (std::size_t k = 0; k < candidates.size(); ++k)
  {
    candidates[k].there = k == 4 ? 1000.0 : 0.0;
    candidates[k].past = k == 4 ? 0.0 : 1000.0;
    candidates[k].ends = k == 4 ? 95.0 : 10.0;
    candidates[k].goesOn = k == 4 ? 5.0 : 90.0;
  }
  const meam::EvidenceRates rates = meam::evidenceRates(candidates, 1.0);
  EXPECT_NEAR(rates.outline.found, (95.0 + 90.0 * 0.9) / 190.0, 1e-12);
  EXPECT_NEAR(rates.outline.chance, (9 * 10.0 + 90.0 * 0.55) / 990.0, 1e-12);
  // However few outlines end where the surface is, three quarters of a part's would.
  candidates[4].ends = 5.0;
  candidates[4].goesOn = 995.0;
  EXPECT_DOUBLE_EQ(meam::evidenceRates(candidates, 1.0).outline.found, 0.75);
  candidates.erase(candidates.begin() + 4); // the others tell nothing
  EXPECT_NEAR(meam::evidenceRates(candidates, 1.0).outline.found, 0.9, 1e-12);
}

TEST(PoseEvidence, WhatLiesBehindTheFloorCannotBeThere)
{
  scenes::Seen seen = scenes::seenCopies();
  const Eigen::AlignedBox3f all = meam::bounds(seen.surface);
  const Eigen::Vector2f low = all.min().head<2>(), high = all.max().head<2>(), around(100, 100);
  parts::add(seen.surface, parts::lattice(low - around, high + around, 1.0f, all.min().z() - 10.0f));
  const meam::Scene scene = scenes::prepared(seen);
  ASSERT_EQ(scene.enclosure.size(), 1u);
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  Eigen::Isometry3d sunk = scenes::threeCopies()[0];
  const meam::EvidenceCounts right = collector.collect(scene.T_local_scene() * sunk).counts;
  EXPECT_EQ(right.enclosed, 0.0);
  sunk.translation().z() -= 2.0 * scenes::bracket().diameter;
  const meam::EvidenceCounts below = collector.collect(scene.T_local_scene() * sunk).counts;
  const meam::TrainedModel& bracket = scenes::bracket();
  const double patch = meam::PatchSize * bracket.diameter;
  EXPECT_EQ(collector.shareBehind(scene.T_local_scene() * sunk), 1.0);
  EXPECT_NEAR(
    below.enclosed, 0.25 * bracket.verificationPoints.size() * bracket.verificationArea() / (patch * patch), 1e-9)
    << "all of it, as far as a body shows its surface";
  // Nor with its upper side in the floor, where all that should be seen is there: its body would be below.
  const Eigen::AlignedBox3f part = meam::bounds(scenes::bracket().surface.points);
  Eigen::Isometry3d lying = Eigen::Isometry3d::Identity();
  lying.translation() << all.max().x() + 50.0, all.center().y(), all.min().z() - 10.0 - part.max().z();
  const meam::EvidenceCounts inTheFloor = collector.collect(scene.T_local_scene() * lying).counts;
  EXPECT_GT(inTheFloor.there, 10.0 * (inTheFloor.hidden + inTheFloor.past));
  EXPECT_GT(inTheFloor.goesOn, inTheFloor.ends);
  EXPECT_GT(inTheFloor.enclosed, 0.2 * inTheFloor.there);
}

TEST(PoseEvidence, NeitherDoesAFlatPartLieInTheFloor)
{
  scenes::Seen seen = scenes::seenCopies();
  const Eigen::AlignedBox3f all = meam::bounds(seen.surface);
  const Eigen::Vector2f low = all.min().head<2>(), high = all.max().head<2>(), around(100, 100);
  const float floor = all.min().z() - 10.0f;
  parts::add(seen.surface, parts::lattice(low - around, high + around, 1.0f, floor));
  const meam::Scene scene = scenes::prepared(seen);
  ASSERT_EQ(scene.enclosure.size(), 1u);
  const meam::EvidenceCollector ofTile(scene, scenes::trained<tile>());
  const auto at = [&](float bottom)
  {
    Eigen::Isometry3d lying = Eigen::Isometry3d::Identity();
    lying.translation() << all.max().x() + 50.0, all.center().y(), bottom;
    return Eigen::Isometry3d(scene.T_local_scene() * lying);
  };
  const meam::EvidenceCounts in = ofTile.collect(at(floor - TileThickness)).counts;
  EXPECT_GT(in.there, 10.0 * (in.hidden + in.past)) << "all that should be seen is there";
  // Deeper than the tolerance lie a face of 900 mm^2 and 135 mm^2 of its sides; a body shows a quarter of them.
  EXPECT_NEAR(in.enclosed / in.there, 0.25 * 1035.0 / 900.0, 0.04);
  EXPECT_EQ(ofTile.collect(at(floor)).counts.enclosed, 0.0);
  // What lies on the floor may be taken for it where it is as thin as the floor is measured.
  EXPECT_EQ(meam::EvidenceCollector(scene, scenes::trained<sheet>()).collect(at(floor - 0.6f)).counts.enclosed, 0.0);
}

TEST(PoseEvidence, OutlineUnderTheFloorDoesNotEnd)
{
  // A pose under a floor's border: beyond the border, where the sensor sees farther, its outline ends.
  scenes::Seen seen = scenes::seenCopies();
  const Eigen::AlignedBox3f all = meam::bounds(seen.surface);
  const float low = all.min().z() - 10.0f, border = all.max().x() + 50.0f;
  const float diameter = static_cast<float>(scenes::bracket().diameter), middle = all.center().y();
  parts::add(seen.surface,
    parts::lattice({ all.min().x() - 100.0f, all.min().y() - 100.0f }, { border, all.max().y() + 100.0f }, 1.0f, low));
  parts::add(seen.surface, parts::lattice({ border, middle - diameter }, { border + diameter, middle + diameter }, 6.0f,
                             low - 3.0f * diameter));
  const meam::Scene scene = scenes::prepared(seen);
  ASSERT_EQ(scene.enclosure.size(), 1u);
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const Eigen::AlignedBox3f part = meam::bounds(scenes::bracket().surface.points);
  Eigen::Isometry3d under = Eigen::Isometry3d::Identity();
  under.translation() << border - part.center().x(), all.center().y() - part.center().y(), low - 0.5 * diameter;
  const meam::EvidenceCounts counts = collector.collect(scene.T_local_scene() * under).counts;
  EXPECT_GT(counts.ends, 1.0);
  EXPECT_LT(counts.goesOn, 0.1 * counts.ends);
  EXPECT_GT(counts.enclosed, 1.0);
}

TEST(PoseEvidence, WhatASurfaceCloseBeforeHidesIsCounted)
{
  // A plate of 40 x 25 mm, 6 mm thick, lies flat; poses below it see its upper side before them.
  const meam::TrainedModel& plate = scenes::trained<barePlate>();
  const Eigen::Isometry3d up(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()));
  const meam::Scene scene = scenes::alone(barePlate(), plate, up);
  const auto below = [&](double millimetres)
  { return Eigen::Isometry3d(scene.T_local_scene() * Eigen::Translation3d(0.0, 0.0, -millimetres) * up); };
  const auto closelyHidden = [&](double millimetres)
  { return meam::EvidenceCollector(scene, plate).closelyHidden(below(millimetres)); };
  EXPECT_EQ(closelyHidden(0.0), 0.0);
  const double hidden = meam::EvidenceCollector(scene, plate).collect(below(3.0)).counts.hidden;
  EXPECT_GT(hidden, 15.0) << "patches, of 44 with the border";
  EXPECT_LE(closelyHidden(3.0), hidden + 1e-9); // farther than the tolerance of 1.4 mm
  EXPECT_GT(closelyHidden(3.0), 0.95 * hidden) << "all but the border, where the plate ends";
  EXPECT_EQ(closelyHidden(8.0), 0.0) << "more than a tenth of the diameter before it";
}

TEST(PoseEvidence, EdgesOnLinesLongerThanThePartSayNothing)
{
  const meam::Scene& scene = scenes::copiesScene();
  ASSERT_EQ(std::count(scene.isOnLongLine.begin(), scene.isOnLongLine.end(), 1), 0);
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const Eigen::Isometry3d T = scene.T_local_scene() * scenes::threeCopies()[0];
  const meam::PoseEvidence alone = collector.collect(T);
  EXPECT_EQ(alone.counts.edgesOfBin, 0.0);
  // An edge that runs along a straight one of the part and far beyond it, as where the part stands in a rim.
  std::size_t on = 0; // of the part's edge points, where the line passes
  while (alone.edgeStates[on] != meam::PointState::Matched)
  {
    ++on;
  }
  scenes::Seen withRim = scenes::seenCopies();
  const Eigen::Isometry3d back = scene.T_local_scene().inverse();
  const int edge = scene.edgeGrid().nearest(alone.edges[on], scenes::bracket().diameter);
  const Eigen::Vector3f middle = (back * alone.edges[on].cast<double>()).cast<float>();
  const Eigen::Vector3f along = (back.linear() * scene.edgePoints().tangents[edge].cast<double>()).cast<float>();
  const float reach = static_cast<float>(scenes::bracket().diameter);
  for (float s = -reach; s <= reach; s += 1.0f)
  {
    withRim.edges.points.push_back(middle + s * along);
    withRim.edges.tangents.push_back(along);
  }
  withRim.edges.weights.resize(withRim.edges.size(), 1.0f);
  const meam::Scene rim = scenes::prepared(withRim);
  const meam::EvidenceCounts there =
    meam::EvidenceCollector(rim, scenes::bracket()).collect(rim.T_local_scene() * scenes::threeCopies()[0]).counts;
  EXPECT_GT(there.edgesOfBin, 10.0);
  EXPECT_GT(there.edgesFound, 0.0) << "the other edges are the part's own";
  EXPECT_LT(there.edgesFound, alone.counts.edgesFound - 5.0);
  EXPECT_LT(there.ends, alone.counts.ends);
  EXPECT_NEAR(there.edgesFound + there.edgesOfBin + there.edgesMissing,
    alone.counts.edgesFound + alone.counts.edgesMissing, 0.05 * alone.edges.size());
}

TEST(PoseEvidence, APoseThatLiesInASurfaceIsGivenAwayByItsOutline)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const Eigen::Isometry3d right = scene.T_local_scene() * scenes::threeCopies()[0];
  const meam::EvidenceCounts counts = collector.collect(right).counts;
  EXPECT_GT(counts.there, 20.0 * (counts.turned + counts.past));
  EXPECT_LT(counts.goesOn, 2.0);
  // Shifted along its upper face the surface goes on where the outline should be.
  Eigen::Isometry3d shifted = scenes::threeCopies()[0];
  shifted.translation().x() += 0.15 * scenes::bracket().diameter;
  const meam::EvidenceCounts beside = collector.collect(scene.T_local_scene() * shifted).counts;
  EXPECT_GT(beside.goesOn, counts.goesOn + 1.0);
  EXPECT_LT(beside.edgesFound, 0.8 * counts.edgesFound);
}

TEST(PoseEvidence, WhereASensorLosesARibIsNotSeenPast)
{
  // Beside a jump it may have measured what is below alone.
  const meam::PoseEvidence narrow = onBarePlate(scenes::trained<ribbedPlate<2>>());
  EXPECT_EQ(narrow.counts.past, 0.0);
  EXPECT_GT(narrow.counts.unmeasured, 0.5);
  const auto& states = narrow.surfaceStates;
  EXPECT_GT(std::count(states.begin(), states.end(), meam::PointState::Unknown), 0);
  const meam::PoseEvidence wide = onBarePlate(scenes::trained<ribbedPlate<14>>());
  EXPECT_GT(wide.counts.past, 5.0) << "a ridge that is not there";
}

TEST(PoseEvidence, TheVisibleFractionIsThatOfTheSurfaceAndWithoutOneOfTheEdges)
{
  using meam::PointState;
  meam::PoseEvidence evidence;
  evidence.edges = { { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } };
  evidence.edgeStates = { PointState::Matched, PointState::Hidden, PointState::Matched };
  EXPECT_DOUBLE_EQ(evidence.visibleFraction(), 2.0 / 3.0);
  evidence.surface = { { 0, 1, 0 }, { 0, 2, 0 }, { 0, 3, 0 }, { 0, 4, 0 } };
  evidence.surfaceStates = { PointState::Violated, PointState::Matched, PointState::Unknown, PointState::Hidden };
  EXPECT_DOUBLE_EQ(evidence.visibleFraction(), 0.75);
}

TEST(PoseEvidence, WithoutFreeSpaceWhatTheSensorLookedPastSaysNothing)
{
  const meam::Scene& scene = scenes::copiesScene();
  Eigen::Isometry3d lifted = scenes::threeCopies()[0]; // in front of all that was measured
  lifted.translation().z() += 40.0;
  meam::EvidenceSettings with, without;
  with.tolerance = without.tolerance = 3.0;
  without.freeSpace = false;
  const auto count = [&](const meam::EvidenceSettings& settings, meam::PointState state)
  {
    const auto states =
      meam::EvidenceCollector(scene, scenes::bracket(), settings).collect(scene.T_local_scene() * lifted).surfaceStates;
    return std::count(states.begin(), states.end(), state);
  };
  EXPECT_GT(count(with, meam::PointState::Violated), 50);
  EXPECT_EQ(count(without, meam::PointState::Violated), 0);
  EXPECT_EQ(count(without, meam::PointState::Unknown),
    count(with, meam::PointState::Unknown) + count(with, meam::PointState::Violated));
}

TEST(PoseEvidence, TheTwoSidesOfAThinStripAreNoTwoOutlines)
{
  // A sheet of 1 % of its diameter: of its face the outline counts as it is long, of its edge by the edge's area.
  const meam::TrainedModel& model = scenes::trained<sheet>();
  const auto seen = [&](const Eigen::Isometry3d& pose)
  {
    const meam::Scene scene = scenes::alone(sheet(), model, pose);
    return meam::EvidenceCollector(scene, model).collect(scene.T_local_scene() * pose);
  };
  const meam::PoseEvidence flat = seen(Eigen::Isometry3d::Identity());
  EXPECT_GT(flat.counts.ends, 20.0) << "sides of patches of 5.8 mm around 160 mm";
  EXPECT_LT(flat.counts.ends + flat.counts.goesOn, 4.0 * flat.counts.inSight);
  const meam::PoseEvidence upright = seen(Eigen::Isometry3d(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX())));
  EXPECT_LT(upright.counts.inSight, 2.0);
  EXPECT_NEAR(upright.counts.ends + upright.counts.goesOn, 4.0 * upright.counts.inSight, 1e-9);
}

TEST(PoseEvidence, BothFacesOfASheetAreVerified)
{
  const meam::TrainedModel& model = scenes::trained<sheet>();
  int up = 0, down = 0;
  for (const int i : model.verificationPoints)
  {
    up += model.surface.normals[i].z() > 0.9f ? 1 : 0;
    down += model.surface.normals[i].z() < -0.9f ? 1 : 0;
  }
  EXPECT_GT(up, 400) << "one for each square of 3 % of 58 mm, of 50 x 30 mm";
  EXPECT_NEAR(down, up, 0.1 * up);
}

TEST(PoseEvidence, ASheetOnTheFloorIsToldFromTheFloor)
{
  // 0.6 mm thick, which is less than a pose may be off: what it lies on would do for its face.
  const meam::TrainedModel& model = scenes::trained<sheet>();
  scenes::Seen seen = scenes::seenFromAbove({ scenes::Copy{ sheet(), Eigen::Isometry3d::Identity() } });
  for (float x = -150.0f; x <= 150.0f; x += 0.5f)
  {
    for (float y = -80.0f; y <= 80.0f; y += 0.5f)
    {
      if (std::abs(x) > 25.0f || std::abs(y) > 15.0f)
      {
        seen.surface.push_back({ x, y, 0.0f });
      }
    }
  }
  const meam::Scene scene = scenes::prepared(scenes::withTangents(seen, model.diameter), model.diameter);
  ASSERT_EQ(scene.enclosure.size(), 1u);
  const meam::EvidenceCollector collector(scene, model);
  const auto at = [&](double x, double above)
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << x, 0.0, above;
    return collector.collect(scene.T_local_scene() * pose).counts;
  };
  const meam::EvidenceCounts right = at(0.0, 0.0);
  EXPECT_GT(right.there, 25.0) << "patches of 5.8 mm of a face of 50 x 30 mm, without its border";
  EXPECT_GT(right.ends, 20.0);
  EXPECT_LT(right.goesOn, 0.5 * right.ends) << "some cells beside the outline have a point of the sheet";
  for (const double above : { -0.6, 0.0, 0.6, 1.0 })
  {
    const meam::EvidenceCounts floor = at(90.0, above);
    EXPECT_LT(floor.there, 1.0) << above;
    EXPECT_LT(floor.ends, 1.0) << above;
    EXPECT_GT(floor.goesOn, 20.0) << above;
  }
}

TEST(PoseEvidence, OddsOfAPlaceTakeTheSurfaceWherePartAndSceneHaveOne)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const meam::EvidenceCounts counts = collector.collect(scene.T_local_scene() * scenes::threeCopies()[0]).counts;
  const meam::TrainedModel& part = scenes::bracket();
  EXPECT_GT(counts.inSight, counts.there);
  EXPECT_EQ(collector.placeOdds(counts, {}, 1.0).sum(), meam::placeOdds(counts, {}, 1.0, part.sheetThickness()).sum());
  meam::TrainedModel edgesAlone = scenes::bracket();
  edgesAlone.surface = {};
  const meam::EvidenceCollector byEdges(scene, edgesAlone);
  EXPECT_EQ(byEdges.placeOdds(counts, {}, 50.0).sum(), meam::placeOddsOfEdges(counts).sum());
}
