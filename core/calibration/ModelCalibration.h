// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace meam
{
/// The logarithm of the odds that something is so, as a line over what was counted or found.
struct LogisticRegression
{
  double constant = 0.0;
  double slope = 1.0;

  double logOdds(double counted) const { return this->constant + this->slope * counted; }
  /// What was counted, of a logarithm of the odds.
  double countedOf(double logOdds) const { return (logOdds - this->constant) / this->slope; }
  bool isIdentity() const { return this->constant == 0.0 && this->slope == 1.0; }
};

/// [0, 1], from the logarithm of odds.
double probabilityOf(double logOdds);

/// What judged poses of a user's own scans have taught about a part: the claims of its poses become those that held
/// there (Platt 1999).
struct ModelCalibration
{
  LogisticRegression place;    ///< of the log odds that a copy is there
  LogisticRegression rotation; ///< and of those that it is turned like this, which 0 and 1 are told apart from
  int poses = 0;               ///< that it was fitted on; 0: nothing was

  /// [0, 1], of a certainty, [0, 1]; one of 1 is of a part that looks like itself in no other rotation.
  double certaintyOf(double certainty) const;
};

/// A pose of which it is known whether it is right.
struct JudgedPose
{
  double placeProbability = 0.0; ///< [0, 1], what was said of it
  double certainty = 1.0;        ///< [0, 1]
  bool isThere = false;       ///< a copy is there, however it is turned by near-symmetries, and no better pose has it
  bool isTurnedRight = false; ///< where one is
  int scene = 0;              ///< that it is in: poses of one scan are not independent
};

/// Of claims of one size, how many hold.
struct ClaimClass
{
  bool withRotation = false; ///< that the pose is right; else that a copy is there
  double least = 0.0;        ///< [0, 1], of what is said,
  double most = 1.0;         ///< the last class with 1, others without `most`
  int poses = 0;
  double right = 0.0;  ///< share of them, [0, 1]
  double before = 0.0; ///< mean of what was said of them,
  double after = 0.0;  ///< and of what is said by a calibration on scans that they are not in
};

/// A calibration, and how it holds: every fifth scan was judged by what the others taught.
struct CalibrationReport
{
  ModelCalibration calibration;
  double lossBefore = 0.0; ///< mean logarithmic loss of right, turned wrongly, and wrong, nats a pose,
  double lossAfter = 0.0;  ///< and of the calibrated ones
  std::vector<ClaimClass> classes;
  std::string warning; ///< of verdicts that are likely exchanged; mostly empty
};

/// Fits a calibration to judged poses of a model that has `before` already: what was said is said by that, and is taken
/// back to what the search itself counted, so that the same poses teach the same again. Places and rotations are each
/// calibrated anew where that makes claims about scans left out better, and stay as they are otherwise.
/// Throws Error for too few poses or scans, and for claims that are no probabilities.
CalibrationReport fitModelCalibration(const std::vector<JudgedPose>& poses, const ModelCalibration& before = {});
}
