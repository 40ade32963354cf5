// SPDX-License-Identifier: BSD-3-Clause
// What holds for every step: its progress rises, it stops when it is told to, and it refuses settings out of range.
#pragma once

#include "TestFiles.h"

#include <functional>
#include <vector>

namespace steps
{
/// `step(progress)` stops where it is told to go on only below one of these shares.
template <typename Step>
void expectStops(Step&& step, const std::vector<double>& shares = { 0.0 })
{
  for (const double stop : shares)
  {
    EXPECT_THROW(step([&](double share) { return share < stop; }), meam::Aborted) << stop;
  }
}

/// Its progress rises to 1, and it stops at each of these shares.
template <typename Step>
void expectProgress(Step&& step, const std::vector<double>& shares = {})
{
  double last = 0.0;
  step(
    [&](double share)
    {
      EXPECT_GE(share, last);
      last = share;
      return true;
    });
  EXPECT_EQ(last, 1.0);
  expectStops(step, shares);
}

/// What is changed in settings, and the words of the error that `step(settings)` gives then; without words, any error.
template <typename Settings>
struct Change
{
  std::function<void(Settings&)> change;
  std::string words = {};
};

template <typename Settings, typename Step>
void expectRefused(Step&& step, const std::vector<Change<Settings>>& changes, const Settings& settings = {})
{
  for (std::size_t k = 0; k < changes.size(); ++k)
  {
    Settings changed = settings;
    changes[k].change(changed);
    const std::string error = files::errorOf([&] { step(changed); });
    EXPECT_TRUE(error != "" && files::contains(error, changes[k].words)) << "change " << k << ": " << error;
  }
}
}
