// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace meam
{
namespace
{
/// What is said of an obstruction; # is its number: a share, an angle, an instance, a rank.
struct Words
{
  const char* reason;
  const char* label;
  const char* copies; ///< that come no farther, after their number
  const char* advice; ///< what to change for these
};

constexpr int Obstructions = static_cast<int>(PickObstruction::Measured) + 1;
constexpr std::array<Words, Obstructions> AllWords{ {
  { "possible", "pick #", "", "" },
  { "the pose is too uncertain", "uncertain", "too uncertain", "lower MinimumProbability, or scan again" },
  { "covered from above to # %", "# % covered", "covered", "pick what lies on them first, or raise MaximumCovered" },
  { "the grasp is for another kind of gripper", "wrong kind", "without a grasp for this kind of gripper",
    "choose the other kind, or have grasps proposed for this one" },
  { "the part is too wide there for the jaws", "too wide", "too wide for the jaws",
    "take a gripper with a larger opening, or other grasps" },
  { "tilted by # degrees", "tilted", "without a grasp from above",
    "raise MaximumTilt, have more grasps proposed or define one by hand, or take another gripper" },
  { "collides with the part itself", "hits the part", "hit by the gripper on its way in",
    "take a slimmer gripper, or have more grasps proposed" },
  { "collides with the bin", "hits the bin", "too near to the bin",
    "take a slimmer or longer gripper, or lower SafetyMargin" },
  { "collides with instance #", "hits #", "too near to another copy",
    "pick the other copies first, take a slimmer gripper, or lower SafetyMargin" },
  { "collides with something measured", "hits something", "too near to something measured",
    "clear it away, take a slimmer gripper, or lower SafetyMargin" },
} };

const Words& wordsOf(PickObstruction obstruction) { return AllWords[static_cast<std::size_t>(obstruction)]; }

std::string withNumber(std::string words, const Pick& pick, int rank)
{
  const double number = pick.obstruction == PickObstruction::Covered    ? 100.0 * pick.covered
                        : pick.obstruction == PickObstruction::Tilted   ? pick.tilt
                        : pick.obstruction == PickObstruction::Instance ? pick.obstacle + 1.0
                                                                        : rank;
  const std::size_t at = words.find('#');
  return at == std::string::npos ? words : words.replace(at, 1, std::to_string(std::lround(number)));
}

/// How far the picks of each copy come; copies that can be picked come to none.
std::map<int, PickObstruction> farthestOfCopies(const Picks& picks)
{
  std::map<int, PickObstruction> farthest;
  for (const Pick& pick : picks)
  {
    const auto [known, first] = farthest.insert({ pick.pose, pick.obstruction });
    if (!first && known->second != PickObstruction::None)
    {
      known->second = pick.possible() ? PickObstruction::None : std::max(known->second, pick.obstruction);
    }
  }
  return farthest;
}

/// Copies by what keeps the gripper from them.
std::array<int, Obstructions> countsOf(const Picks& picks)
{
  std::array<int, Obstructions> counts{};
  for (const auto& [pose, obstruction] : farthestOfCopies(picks))
  {
    ++counts[static_cast<std::size_t>(obstruction)];
  }
  return counts;
}
}

std::string describe(const Pick& pick) { return withNumber(wordsOf(pick.obstruction).reason, pick, 0); }

std::string labelOf(const Pick& pick, int rank) { return withNumber(wordsOf(pick.obstruction).label, pick, rank); }

std::string describe(const Picks& picks)
{
  if (picks.empty())
  {
    return "There is no copy to pick.";
  }
  const std::array<int, Obstructions> counts = countsOf(picks);
  const auto possible = std::count_if(picks.begin(), picks.end(), [](const Pick& pick) { return pick.possible(); });
  int copies = 0;
  std::string others;
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    copies += counts[k];
    if (k > 0 && counts[k] > 0)
    {
      others += (others.empty() ? "; the others: " : ", ") + std::to_string(counts[k]) + " " + AllWords[k].copies;
    }
  }
  return std::to_string(counts[0]) + " of " + std::to_string(copies) + " copies can be picked, by " +
         std::to_string(possible) + " of " + std::to_string(picks.size()) + " picks" + others + ".";
}

std::string adviceOn(const Picks& picks)
{
  const std::array<int, Obstructions> counts = countsOf(picks);
  std::string text;
  for (std::size_t k = 1; k < counts.size(); ++k)
  {
    if (counts[k] > 0)
    {
      text +=
        (text.empty() ? "Copies " : " Copies ") + std::string(AllWords[k].copies) + ": " + AllWords[k].advice + ".";
    }
  }
  return text;
}
}
