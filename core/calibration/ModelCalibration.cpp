// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/ModelCalibration.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace meam
{
namespace
{
constexpr int LeastPoses = 20;   // of fewer the line is what is known before, and little else
constexpr int Folds = 5;         // scans that are left out in turn are one of so many, and no fewer scans will do
constexpr double Extreme = 12.0; // log odds: what is said more surely is taken for that
// What is known before any pose is judged: that the product's own probabilities are not far off.
constexpr double ConstantDeviation = 2.0;
constexpr double SlopeDeviation = 0.5;
constexpr double LeastSlope = 0.1;  // claims stay in their order
constexpr double LeastClaim = 1e-9; // a probability that a logarithmic loss takes for less
constexpr double Limits[] = { 0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 1.0 };

double logOddsOf(double probability)
{
  return std::clamp(std::log(probability) - std::log1p(-probability), -Extreme, Extreme);
}

/// What the search counted, in log odds, and whether it is so.
struct Claim
{
  double logOdds;
  bool holds;
};

/// Log odds, of what a calibrated model said.
double countedOf(double said, const LogisticRegression& before)
{
  return std::clamp(before.countedOf(logOddsOf(said)), -Extreme, Extreme);
}

double probabilityBy(const LogisticRegression& line, double said) { return probabilityOf(line.logOdds(said)); }

double lossOf(double probability, bool holds)
{
  return -std::log(std::max(holds ? probability : 1.0 - probability, LeastClaim));
}

/// Constant and slope of largest posterior probability, by Newton's method; the slope alone may be given.
LogisticRegression newton(const std::vector<Claim>& claims, LogisticRegression line, bool fitsSlope)
{
  const auto objective = [&](const LogisticRegression& at)
  {
    double sum =
      0.5 * std::pow(at.constant / ConstantDeviation, 2) + 0.5 * std::pow((at.slope - 1.0) / SlopeDeviation, 2);
    for (const Claim& claim : claims)
    {
      const double x = at.logOdds(claim.logOdds);
      sum += (claim.holds ? std::log1p(std::exp(-x)) : std::log1p(std::exp(x))); // |x| stays far from overflow
    }
    return sum;
  };
  for (int step = 0; step < 50; ++step) // a few do; no more, whatever rounding makes of the last digits
  {
    Eigen::Vector2d gradient(
      line.constant / std::pow(ConstantDeviation, 2), (line.slope - 1.0) / std::pow(SlopeDeviation, 2));
    Eigen::Matrix2d curvature =
      Eigen::Vector2d(std::pow(ConstantDeviation, -2), std::pow(SlopeDeviation, -2)).asDiagonal();
    for (const Claim& claim : claims)
    {
      const Eigen::Vector2d input(1.0, claim.logOdds);
      const double p = probabilityBy(line, claim.logOdds);
      gradient += (p - (claim.holds ? 1.0 : 0.0)) * input;
      curvature += p * (1.0 - p) * input * input.transpose();
    }
    if (!fitsSlope)
    {
      gradient[1] = 0.0;
      curvature(0, 1) = curvature(1, 0) = 0.0;
    }
    const Eigen::Vector2d move = curvature.ldlt().solve(gradient);
    double share = 1.0;
    const auto moved = [&] {
      return LogisticRegression{ line.constant - share * move[0], line.slope - share * move[1] };
    };
    while (share > 1e-6 && objective(moved()) > objective(line))
    {
      share *= 0.5;
    }
    line = moved();
    if (move.norm() < 1e-10)
    {
      break;
    }
  }
  return line;
}

LogisticRegression fitted(const std::vector<Claim>& claims)
{
  const LogisticRegression free = newton(claims, {}, true);
  return free.slope >= LeastSlope ? free : newton(claims, { 0.0, LeastSlope }, false);
}

bool hasRotations(const JudgedPose& pose) { return pose.certainty < 1.0; }

void check(const std::vector<JudgedPose>& poses, std::size_t scenes)
{
  for (const JudgedPose& pose : poses)
  {
    if (!(pose.placeProbability >= 0.0 && pose.placeProbability <= 1.0 && pose.certainty >= 0.0 &&
          pose.certainty <= 1.0))
    {
      throw Error("A judged pose has a probability or a certainty that is not between 0 and 1: give poses as detection "
                  "left them.");
    }
  }
  if (poses.size() < LeastPoses || scenes < Folds)
  {
    throw Error("Probabilities are calibrated on " + std::to_string(LeastPoses) + " judged poses in " +
                std::to_string(Folds) + " scans at least, and better on a few dozen scans; here are " +
                std::to_string(poses.size()) + " in " + std::to_string(scenes) + ".");
  }
}

/// Which fold each pose is in: those of a scene are in one.
std::vector<int> foldsOf(const std::vector<JudgedPose>& poses, const std::set<int>& scenes)
{
  return mapped<int>(poses, [&](const JudgedPose& pose)
    { return static_cast<int>(std::distance(scenes.begin(), scenes.find(pose.scene))) % Folds; });
}

/// Lines for each fold, fitted on all others; none where `before` is better for the scans left out.
std::vector<LogisticRegression> heldOut(
  const std::vector<Claim>& claims, const std::vector<int>& folds, const LogisticRegression& before)
{
  std::vector<LogisticRegression> lines;
  double gain = 0.0;
  for (int fold = 0; fold < Folds; ++fold)
  {
    std::vector<Claim> others;
    for (std::size_t k = 0; k < claims.size(); ++k)
    {
      if (folds[k] != fold)
      {
        others.push_back(claims[k]);
      }
    }
    lines.push_back(fitted(others));
    for (std::size_t k = 0; k < claims.size(); ++k)
    {
      if (folds[k] == fold)
      {
        gain += lossOf(probabilityBy(before, claims[k].logOdds), claims[k].holds) -
                lossOf(probabilityBy(lines.back(), claims[k].logOdds), claims[k].holds);
      }
    }
  }
  return gain > 0.0 ? lines : std::vector<LogisticRegression>();
}

/// Of a copy that is turned right, one that is turned wrongly, and none.
double lossOf(const JudgedPose& pose)
{
  return lossOf(pose.placeProbability, pose.isThere) +
         (pose.isThere && hasRotations(pose) ? lossOf(pose.certainty, pose.isTurnedRight) : 0.0);
}

/// One judged pose with what is said of it before and after.
struct Told
{
  double before;
  double after;
  bool holds;
};

/// Claims that are right no more often where they are surer: likely the verdicts are wrong.
std::string doubtOf(const ModelCalibration& calibration)
{
  std::string surer;
  for (const auto& [line, claim] :
    { std::pair(calibration.place, "a copy is there"), std::pair(calibration.rotation, "the rotation is right") })
  {
    surer += line.slope > LeastSlope ? std::string() : (surer.empty() ? "" : ", or that ") + std::string(claim);
  }
  return surer.empty() ? surer
                       : "Where the model is surer that " + surer +
                           ", it is not right more often: see that the verdicts are of these poses, and right and "
                           "wrong not exchanged.";
}

void addClasses(const std::vector<Told>& told, bool withRotation, std::vector<ClaimClass>& classes)
{
  for (std::size_t k = 0; k + 1 < std::size(Limits); ++k)
  {
    ClaimClass these{ withRotation, Limits[k], Limits[k + 1] };
    for (const Told& one : told)
    {
      if (one.before >= these.least && (one.before < these.most || these.most == 1.0))
      {
        ++these.poses;
        these.right += one.holds ? 1.0 : 0.0;
        these.before += one.before;
        these.after += one.after;
      }
    }
    if (these.poses > 0)
    {
      for (double* sum : { &these.right, &these.before, &these.after })
      {
        *sum /= these.poses;
      }
      classes.push_back(these);
    }
  }
}
}

double probabilityOf(double logOdds) { return 1.0 / (1.0 + std::exp(-logOdds)); }

double ModelCalibration::certaintyOf(double certainty) const
{
  return certainty < 1.0 && !this->rotation.isIdentity() ? probabilityBy(this->rotation, logOddsOf(certainty))
                                                         : certainty;
}

CalibrationReport fitModelCalibration(const std::vector<JudgedPose>& poses, const ModelCalibration& before)
{
  std::set<int> scenes;
  std::transform(
    poses.begin(), poses.end(), std::inserter(scenes, scenes.end()), [](const JudgedPose& pose) { return pose.scene; });
  check(poses, scenes.size());
  const std::vector<int> folds = foldsOf(poses, scenes);
  std::vector<Claim> places, rotations;
  std::vector<int> foldsOfRotations;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    places.push_back({ countedOf(poses[k].placeProbability, before.place), poses[k].isThere });
    if (poses[k].isThere && hasRotations(poses[k]))
    {
      rotations.push_back({ countedOf(poses[k].certainty, before.rotation), poses[k].isTurnedRight });
      foldsOfRotations.push_back(folds[k]);
    }
  }
  const std::vector<LogisticRegression> placeLines = heldOut(places, folds, before.place);
  const std::vector<LogisticRegression> rotationLines =
    heldOut(rotations, foldsOfRotations, before.rotation); // of few or none `before` is kept
  const bool keepsPlaces = placeLines.empty(), keepsRotations = rotationLines.empty();

  CalibrationReport report;
  report.calibration = before;
  if (!keepsPlaces || !keepsRotations)
  {
    report.calibration = { keepsPlaces ? before.place : fitted(places),
      keepsRotations ? before.rotation : fitted(rotations), static_cast<int>(poses.size()) };
  }
  std::vector<Told> ofPlaces, ofPoses;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    const JudgedPose& pose = poses[k];
    JudgedPose after = pose;
    if (!keepsPlaces)
    {
      after.placeProbability = probabilityBy(placeLines[folds[k]], places[k].logOdds);
    }
    if (!keepsRotations && hasRotations(pose))
    {
      after.certainty = probabilityBy(rotationLines[folds[k]], countedOf(pose.certainty, before.rotation));
    }
    ofPlaces.push_back({ pose.placeProbability, after.placeProbability, pose.isThere });
    ofPoses.push_back({ pose.placeProbability * pose.certainty, after.placeProbability * after.certainty,
      pose.isThere && pose.isTurnedRight });
    report.lossBefore += lossOf(pose) / static_cast<double>(poses.size());
    report.lossAfter += lossOf(after) / static_cast<double>(poses.size());
  }
  addClasses(ofPlaces, false, report.classes);
  addClasses(ofPoses, true, report.classes);
  report.warning = doubtOf(report.calibration);
  return report;
}
}
