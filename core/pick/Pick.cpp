// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Pick.h"

#include <array>
#include <cmath>
#include <iterator>
#include <set>

namespace meam
{
std::string describe(const Pick& pick)
{
  switch (pick.obstruction)
  {
    case PickObstruction::None:
      return "possible";
    case PickObstruction::Uncertain:
      return "the pose is too uncertain";
    case PickObstruction::Covered:
      return "covered from above to " + std::to_string(static_cast<int>(std::lround(100.0 * pick.covered))) + " %";
    case PickObstruction::WrongKind:
      return "the grasp is for another kind of gripper";
    case PickObstruction::TooWide:
      return "the part is too wide there for the jaws";
    case PickObstruction::Tilted:
      return "tilted by " + std::to_string(static_cast<int>(std::lround(pick.tilt))) + " degrees";
    case PickObstruction::PartItself:
      return "collides with the part itself";
    case PickObstruction::Bin:
      return "collides with the bin";
    case PickObstruction::Instance:
      return "collides with instance " + std::to_string(pick.obstacle + 1);
    case PickObstruction::Measured:
      return "collides with something measured";
  }
  return {};
}

std::string labelOf(const Pick& pick, int rank)
{
  switch (pick.obstruction)
  {
    case PickObstruction::None:
      return "pick " + std::to_string(rank);
    case PickObstruction::Uncertain:
      return "uncertain";
    case PickObstruction::Covered:
      return std::to_string(std::lround(100.0 * pick.covered)) + " % covered";
    case PickObstruction::WrongKind:
      return "wrong kind";
    case PickObstruction::TooWide:
      return "too wide";
    case PickObstruction::Tilted:
      return "tilted";
    case PickObstruction::PartItself:
      return "hits the part";
    case PickObstruction::Bin:
      return "hits the bin";
    case PickObstruction::Instance:
      return "hits " + std::to_string(pick.obstacle + 1);
    case PickObstruction::Measured:
      return "hits something";
  }
  return {};
}

std::string describe(const Picks& picks)
{
  static const char* const names[] = { "possible", "of uncertain poses", "covered", "of another kind of gripper",
    "too wide", "tilted", "against the part itself", "against the bin", "against another copy",
    "against something measured" };
  std::array<int, std::size(names)> counts{};
  std::set<int> all;
  std::set<int> graspable;
  for (const Pick& pick : picks)
  {
    ++counts[static_cast<std::size_t>(pick.obstruction)];
    all.insert(pick.pose);
    if (pick.possible())
    {
      graspable.insert(pick.pose);
    }
  }
  std::string text = std::to_string(graspable.size()) + " of " + std::to_string(all.size()) +
                     " copies can be picked, by " + std::to_string(counts[0]) + " of " + std::to_string(picks.size()) +
                     " picks";
  for (std::size_t k = 1; k < counts.size(); ++k)
  {
    if (counts[k] > 0)
    {
      text += (text.find(';') == std::string::npos ? "; " : ", ") + std::to_string(counts[k]) + " " + names[k];
    }
  }
  return text + ".";
}
}
