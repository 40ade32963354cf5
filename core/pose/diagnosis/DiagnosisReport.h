// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/diagnosis/PoseDiagnosis.h"

#include <string>
#include <vector>

namespace meam
{
/// The step that lost a part, and why, in a plain sentence.
std::string verdictOf(const Diagnosis& diagnosis, const DetectionSettings& detection);

/// What to change: in the scan, or properties of the filter MEAM Pose Estimation; empty where nothing was lost.
std::string adviceOf(const Diagnosis& diagnosis, const DetectionSettings& detection);

/// What speaks most for the place and most against it, two sentences at most; empty with the paper's verification.
std::string mainReasonOf(const Diagnosis& diagnosis);

/// What speaks for the place and what against it, in the logarithm of odds, what may be another part that looks alike,
/// how sure the rotation is, and the nearest other pose: a sentence each.
std::vector<std::string> reasonsOf(const Diagnosis& diagnosis);

/// A number of a step.
struct DiagnosisNumber
{
  std::string step;
  std::string what;
  double value;
  double of; ///< the value is a count out of so many, or is compared with this; NaN: it stands alone
};

/// All numbers, step by step.
std::vector<DiagnosisNumber> numbersOf(const Diagnosis& diagnosis);

/// How a stage is called.
std::string nameOf(PoseStage stage);
}
