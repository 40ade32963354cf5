// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"

namespace meam
{
// What is wrong with a trained model that comes from a file. All throw Error that says what it is and what to do.

/// Says what: "The trained model `what`", and how to get a whole one.
[[noreturn]] void refuseModel(const std::string& what);

/// Throws unless `version` is the one that this program reads.
void requireModelVersion(double version);

/// Throws for a diameter or settings out of range, and so before anything as long as the pair table is read.
void requireModelSettings(const TrainedModel& model);

/// Throws for all else that detection could fail on: arrays whose lengths do not fit, values that are not numbers,
/// views and edge points that do not exist. What deriveFields() makes is not looked at. To be called before it.
void requireModel(const TrainedModel& model);
}
