// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/HandEyeCalibration.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "base/sequences/Sequences.h"
#include "scene/Units.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

namespace meam
{
namespace
{
constexpr double LeastTurn = 5.0; // degrees that some motions have to turn, about axes that are not parallel

// A fit beyond these is no calibration: poses of a poor camera and robot stay within 10 mm and 2 degrees.
constexpr double MostShift = 20.0;    // mm, root mean square
constexpr double MostTurn = 5.0;      // degrees
constexpr double MostOutliers = 0.25; // share of the pairs that may stand out
// Where a few pairs are wrong, wrong explanations of all may come within the above:
constexpr double MuchBetter = 0.7; // times its residual another explanation has, which then takes its place
constexpr double WellFits =
  5.0; // mm: below it residuals tell nothing, and no outliers are looked for, which takes long

// Of a fit that is one, a pair so far off: of errors that are normal the farthest of twenty is 2.2 medians off.
constexpr double StandsOut = 5.0;    // medians
constexpr double LeastOutlier = 2.0; // mm

constexpr std::size_t FewestPairs = 3;

// Of two poses of a gripper that are one: mm, and of rotations what is printed with three decimals.
constexpr double SamePose = 1e-3;

// How sure the place is. Simulated, what is told is 1 to 1.3 times the error of 8 pairs and more, and of 5 twice.
constexpr std::size_t FewestToTell = 5; // places of the gripper; of 4 it is 3 to 20 times the error
constexpr std::size_t MostLeftOut = 40; // groups that are left out in turn: more only take longer
constexpr double Unsure = 3.0;          // mm, of a place that no gripper should be sent by
constexpr double MostUnsure = 50.0;     // mm, of a place that is none

// A target of another size. Noise alone takes a quarter off the residual of five pairs at most, of 4 a half.
constexpr double MuchBetterScaled = 0.5; // times the residual
constexpr double ScaleStep = 0.05;       // the squared residual is a parabola of the scale, whatever the step
constexpr double MostScale = 2.0;        // no one mistakes a board's size by more; units have other words

// Where both poses of all pairs are inverse, camera and target change places.
constexpr double Near = 300.0; // mm, of what a gripper holds
constexpr double Far = 500.0;  // mm, as far as no gripper holds it
constexpr double Degrees = 180.0 / M_PI;

const std::pair<cv::HandEyeCalibrationMethod, const char*> Methods[] = { { cv::CALIB_HAND_EYE_PARK, "Park" },
  { cv::CALIB_HAND_EYE_HORAUD, "Horaud" }, { cv::CALIB_HAND_EYE_DANIILIDIS, "Daniilidis" },
  { cv::CALIB_HAND_EYE_TSAI, "Tsai" } };

using HandEyePairs = std::vector<HandEyePair>;

Eigen::Isometry3d requireRigid(const Eigen::Isometry3d& T, const char* name, std::size_t pair)
{
  const std::optional<Eigen::Isometry3d> rigid = rigidOf(T.matrix());
  if (!rigid)
  {
    throw Error("The " + std::string(name) + " of pair " + std::to_string(pair + 1) +
                " is not a rotation and a translation: check its 4x4 matrix.");
  }
  Eigen::Isometry3d exact = *rigid;
  exact.linear() = Eigen::Quaterniond(rigid->linear()).normalized().toRotationMatrix();
  return exact;
}

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R)
{
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// The motions between all poses have to turn about two axes that are not parallel.
void requireTurns(const std::vector<Eigen::Isometry3d>& poses, const char* what, double leastTurn)
{
  std::vector<Eigen::Vector3d> turns;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    for (std::size_t k = i + 1; k < poses.size(); ++k)
    {
      turns.push_back(rotationVector(poses[i].linear().transpose() * poses[k].linear()));
    }
  }
  const Eigen::Vector3d largest = *std::max_element(turns.begin(), turns.end(),
    [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
  if (largest.norm() * Degrees < leastTurn)
  {
    throw Error(std::string("The motions of the ") + what + " turn by less than " +
                std::to_string(static_cast<int>(leastTurn)) +
                " degrees, which leaves the camera's place open: turn the gripper by 30 degrees and more about several "
                "axes.");
  }
  const auto aside = [&](const Eigen::Vector3d& turn)
  { return turn.cross(largest.normalized()).norm() * Degrees >= leastTurn; };
  if (std::none_of(turns.begin(), turns.end(), aside))
  {
    throw Error(std::string("All motions of the ") + what +
                " turn about parallel axes, which leaves the camera's place along them open: turn the gripper about a "
                "second axis by 30 degrees and more.");
  }
}

/// The mean of poses: of their translations, and the rotation nearest to the mean of their matrices.
Eigen::Isometry3d meanOf(const std::vector<Eigen::Isometry3d>& poses)
{
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Eigen::Isometry3d& pose : poses)
  {
    sum += pose.matrix() / static_cast<double>(poses.size());
  }
  Eigen::Isometry3d mean = Eigen::Isometry3d::Identity();
  mean.linear() = nearestRotation(sum.topLeftCorner<3, 3>());
  mean.translation() = sum.topRightCorner<3, 1>();
  return mean;
}

double rootMeanSquare(const std::vector<double>& values)
{
  return std::sqrt(sumOf(values, [](double value) { return value * value; }) / static_cast<double>(values.size()));
}

/// The spread of the target when the camera is there.
HandEyeCalibration judged(
  const Eigen::Isometry3d& T_robot_camera, const std::vector<HandEyePair>& pairs, CameraMount mount)
{
  std::vector<Eigen::Isometry3d> targets;
  for (const HandEyePair& pair : pairs)
  {
    const Eigen::Isometry3d T_holder_robot =
      mount == CameraMount::Hand ? pair.T_base_gripper : pair.T_base_gripper.inverse();
    targets.push_back(T_holder_robot * T_robot_camera * pair.T_camera_target);
  }
  HandEyeCalibration result;
  result.mount = mount;
  result.T_robot_camera = T_robot_camera;
  result.T_holder_target = meanOf(targets);
  for (const Eigen::Isometry3d& target : targets)
  {
    const Eigen::Isometry3d off = result.T_holder_target.inverse() * target;
    result.shifts.push_back(off.translation().norm());
    result.turns.push_back(rotationVector(off.linear()).norm() * Degrees);
  }
  result.shift = rootMeanSquare(result.shifts);
  result.turn = rootMeanSquare(result.turns);
  return result;
}

/// What one of OpenCV's methods finds; none when it finds nothing.
std::optional<Eigen::Isometry3d> solved(
  const std::vector<HandEyePair>& pairs, CameraMount mount, cv::HandEyeCalibrationMethod method)
{
  std::vector<cv::Mat> robotTurns, robotShifts, targetTurns, targetShifts;
  const auto append = [](const Eigen::Isometry3d& T, std::vector<cv::Mat>& turns, std::vector<cv::Mat>& shifts)
  {
    cv::Mat turn(3, 3, CV_64F), shift(3, 1, CV_64F);
    for (int row = 0; row < 3; ++row)
    {
      shift.at<double>(row) = T(row, 3);
      for (int column = 0; column < 3; ++column)
      {
        turn.at<double>(row, column) = T(row, column);
      }
    }
    turns.push_back(turn);
    shifts.push_back(shift);
  };
  for (const HandEyePair& pair : pairs)
  {
    // OpenCV solves for a camera on the gripper; for one beside the robot base and gripper change places.
    append(mount == CameraMount::Hand ? pair.T_base_gripper : pair.T_base_gripper.inverse(), robotTurns, robotShifts);
    append(pair.T_camera_target, targetTurns, targetShifts);
  }
  cv::Mat turn, shift;
  try
  {
    cv::calibrateHandEye(robotTurns, robotShifts, targetTurns, targetShifts, turn, shift, method);
  }
  catch (const cv::Exception&)
  {
    return {};
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row)
  {
    T(row, 3) = shift.at<double>(row);
    for (int column = 0; column < 3; ++column)
    {
      T(row, column) = turn.at<double>(row, column);
    }
  }
  if (!T.matrix().allFinite() || !(T.linear().determinant() > 0.0))
  {
    return {};
  }
  T.linear() = nearestRotation(T.linear());
  return T;
}

/// By the method under which the target moves least; none when none finds anything.
std::optional<HandEyeCalibration> bestOf(const HandEyePairs& pairs, CameraMount mount)
{
  std::optional<HandEyeCalibration> best;
  for (const auto& [method, name] : Methods)
  {
    if (const auto found = solved(pairs, mount, method))
    {
      HandEyeCalibration calibration = judged(*found, pairs, mount);
      calibration.method = name;
      if (std::isfinite(calibration.shift) && (!best || calibration.shift < best->shift))
      {
        best = calibration;
      }
    }
  }
  return best;
}

bool isSane(const std::optional<HandEyeCalibration>& calibration)
{
  return calibration && calibration->shift <= MostShift && calibration->turn <= MostTurn;
}

/// All pairs after a change of each.
template <typename Change>
HandEyePairs changed(HandEyePairs pairs, const Change& change)
{
  std::for_each(pairs.begin(), pairs.end(), change);
  return pairs;
}

/// Each gripper with the target of `lag` pairs later, or earlier.
HandEyePairs shifted(const HandEyePairs& pairs, int lag)
{
  HandEyePairs result;
  for (int k = 0; k < static_cast<int>(pairs.size()); ++k)
  {
    if (k + lag >= 0 && k + lag < static_cast<int>(pairs.size()))
    {
      result.push_back({ pairs[k].T_base_gripper, pairs[k + lag].T_camera_target });
    }
  }
  return result;
}

HandEyePairs scaledTargets(const HandEyePairs& pairs, double scale)
{
  return changed(pairs, [scale](HandEyePair& pair) { pair.T_camera_target.translation() *= scale; });
}

/// How many times as large as its poses say the target is, if the pairs fit much better then; else 1.
double targetScaleOf(const HandEyePairs& pairs, CameraMount mount)
{
  const auto squares = [&](double scale)
  {
    const HandEyePairs scaled = scaledTargets(pairs, scale);
    const auto found = solved(scaled, mount, cv::CALIB_HAND_EYE_PARK); // its rotation does not change with the scale
    return found ? std::pow(judged(*found, scaled, mount).shift, 2) : std::numeric_limits<double>::quiet_NaN();
  };
  const double less = squares(1.0 - ScaleStep), now = squares(1.0), more = squares(1.0 + ScaleStep);
  const double scale = 1.0 + 0.5 * ScaleStep * (less - more) / (less - 2.0 * now + more);
  const bool isBetter = scale < MostScale && scale > 1.0 / MostScale && pairs.size() >= FewestToTell &&
                        squares(scale) < MuchBetterScaled * MuchBetterScaled * now;
  return isBetter ? scale : 1.0;
}

std::string scaleWords(double scale)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", scale);
  return "if the target is " + std::string(text) +
         " times as large as its poses say: check the size of the board's squares, or of the part.";
}

/// Of each pair the place of its gripper, counted from 0.
std::vector<std::size_t> placesOf(const HandEyePairs& pairs)
{
  std::vector<std::size_t> places;
  HandEyePairs apart;
  for (const HandEyePair& pair : pairs)
  {
    const auto same = std::find_if(apart.begin(), apart.end(),
      [&pair](const HandEyePair& other)
      { return (pair.T_base_gripper.matrix() - other.T_base_gripper.matrix()).cwiseAbs().maxCoeff() <= SamePose; });
    places.push_back(static_cast<std::size_t>(same - apart.begin()));
    if (same == apart.end())
    {
      apart.push_back(pair);
    }
  }
  return places;
}

/// HandEyeCalibration::uncertainty, of a calibration by one of the methods.
double uncertaintyOf(const HandEyePairs& pairs, const HandEyeCalibration& calibration)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> places = placesOf(pairs);
  const std::size_t groups = std::min(1 + *std::max_element(places.begin(), places.end()), MostLeftOut);
  if (groups < FewestToTell)
  {
    return unknown;
  }
  const auto method = std::find_if(std::begin(Methods), std::end(Methods),
    [&calibration](const auto& each) { return each.second == calibration.method; });
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
  for (const HandEyePair& pair : pairs)
  {
    seen += pair.T_camera_target.translation() / static_cast<double>(pairs.size());
  }
  PrecisePoints points;
  for (std::size_t group = 0; group < groups; ++group)
  {
    HandEyePairs others;
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      if (places[k] % groups != group)
      {
        others.push_back(pairs[k]);
      }
    }
    const auto found = solved(others, calibration.mount, method->first);
    if (!found)
    {
      return unknown;
    }
    points.push_back(*found * seen);
  }
  const double count = static_cast<double>(groups);
  const Eigen::Vector3d mean = std::accumulate(points.begin(), points.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) / count;
  return std::sqrt((count - 1.0) / count *
                   sumOf(points, [&mean](const Eigen::Vector3d& point) { return (point - mean).squaredNorm(); }));
}

struct Mistake
{
  std::string what;
  std::function<void(HandEyePair&)> undo;
};

std::vector<Mistake> mistakesInUse()
{
  std::vector<Mistake> mistakes{ { "one of its poses is inverse",
                                   [](HandEyePair& pair) { pair.T_camera_target = pair.T_camera_target.inverse(); } },
    { "both poses of a pair are inverse",
      [](HandEyePair& pair) {
        pair = { pair.T_base_gripper.inverse(), pair.T_camera_target.inverse() };
      } },
    { "the grippers' rotations are transposed",
      [](HandEyePair& pair) { pair.T_base_gripper.linear().transposeInPlace(); } },
    { "the targets' rotations are transposed",
      [](HandEyePair& pair) { pair.T_camera_target.linear().transposeInPlace(); } } };
  for (const LengthUnit& unit : UnitsBesideMM)
  {
    const std::string name = unit.name;
    mistakes.push_back({ "the grippers' poses are in " + name + ", the targets' in mm",
      [unit](HandEyePair& pair) { pair.T_base_gripper.translation() *= unit.length; } });
    mistakes.push_back({ "the targets' poses are in " + name + ", the grippers' in mm",
      [unit](HandEyePair& pair) { pair.T_camera_target.translation() *= unit.length; } });
  }
  return mistakes;
}

/// The pairs that stand out: those without which all others fit, the worst first; none when they are more than a share.
std::vector<std::size_t> outliersOf(const HandEyePairs& pairs, CameraMount mount)
{
  std::vector<std::size_t> left(pairs.size()), out;
  std::iota(left.begin(), left.end(), 0);
  const std::size_t most = std::max<std::size_t>(1, static_cast<std::size_t>(MostOutliers * pairs.size()));
  while (out.size() < most && left.size() > FewestPairs + 1)
  {
    std::optional<HandEyeCalibration> best;
    std::size_t worst = 0;
    for (std::size_t leaving = 0; leaving < left.size(); ++leaving)
    {
      HandEyePairs others;
      for (std::size_t k = 0; k < left.size(); ++k)
      {
        if (k != leaving)
        {
          others.push_back(pairs[left[k]]);
        }
      }
      const std::optional<HandEyeCalibration> found = bestOf(others, mount);
      if (found && (!best || found->shift < best->shift))
      {
        best = found;
        worst = leaving;
      }
    }
    if (!best)
    {
      return {};
    }
    out.push_back(left[worst]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(worst));
    if (isSane(best))
    {
      return out;
    }
  }
  return {};
}

/// What the pairs may look like: the explanation under which they fit best.
class Explanations
{
public:
  /// Of pairs under which it holds, unless another explanation fits well.
  template <typename Pairs>
  void consider(const Pairs& pairs, CameraMount mount, const std::string& words)
  {
    if (this->Shift <= WellFits)
    {
      return;
    }
    const std::optional<HandEyeCalibration> fit = bestOf(pairs(), mount);
    if (isSane(fit) && std::max(fit->shift, WellFits) < MuchBetter * this->Shift)
    {
      this->Shift = std::max(fit->shift, WellFits);
      this->Words = words;
    }
  }
  const std::string& words() const { return this->Words; } ///< empty: nothing fits
  double shift() const { return this->Shift; }             ///< mm

private:
  double Shift = std::numeric_limits<double>::infinity(); ///< mm
  std::string Words;
};

void considerOutliers(
  const HandEyePairs& pairs, CameraMount mount, const std::vector<Mistake>& mistakes, Explanations& all)
{
  const std::vector<std::size_t> out = outliersOf(pairs, mount);
  if (out.empty())
  {
    return;
  }
  std::string which;
  HandEyePairs others;
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    if (std::find(out.begin(), out.end(), k) == out.end())
    {
      others.push_back(pairs[k]);
    }
  }
  for (const std::size_t pair : out)
  {
    which += (which.empty() ? "" : ", ") + std::to_string(pair + 1);
  }
  const std::optional<HandEyeCalibration> without = bestOf(others, mount); // found, or there are no outliers
  const auto mistake = std::find_if(mistakes.begin(), mistakes.end(),
    [&](const Mistake& each)
    {
      HandEyePairs mended = pairs;
      std::for_each(out.begin(), out.end(), [&](std::size_t pair) { each.undo(mended[pair]); });
      const std::optional<HandEyeCalibration> withThem = bestOf(mended, mount);
      return isSane(withThem) && MuchBetter * withThem->shift < without->shift;
    });
  all.consider([&] { return others; }, mount,
    "Without pair " + which + " the others fit" +
      (mistake == mistakes.end() ? std::string(": leave it out.") : ", and with it if in it " + mistake->what + "."));
}

/// What the pairs look like under which a camera would fit: in a sentence or two.
std::string suspicionOf(const HandEyePairs& pairs, CameraMount mount, const HandEyeCalibration& found)
{
  const CameraMount other = mount == CameraMount::Hand ? CameraMount::Beside : CameraMount::Hand;
  const std::string fitsOther =
    other == CameraMount::Hand ? "They fit a camera on the hand" : "They fit a camera beside the robot";
  const std::vector<Mistake> mistakes = mistakesInUse();
  Explanations all;
  all.consider([&] { return pairs; }, other,
    fitsOther + ": set the mount; or the poses of all targets (T_target_camera), or of all grippers, are inverse.");
  for (const Mistake& mistake : mistakes)
  {
    all.consider([&] { return changed(pairs, mistake.undo); }, mount, "They fit if " + mistake.what + ": change that.");
  }
  if (const double scale = targetScaleOf(pairs, mount); scale != 1.0)
  {
    all.consider([&] { return scaledTargets(pairs, scale); }, mount, "They fit " + scaleWords(scale));
  }
  for (std::size_t lag = 1; 2 * lag <= pairs.size() && pairs.size() - lag > FewestPairs; ++lag)
  {
    for (const int sign : { 1, -1 })
    {
      all.consider([&] { return shifted(pairs, sign * static_cast<int>(lag)); }, mount,
        "They fit if each gripper belongs to the target of the pair " + std::to_string(lag) +
          (sign > 0 ? " later" : " earlier") + ": the lists are shifted against each other.");
    }
  }
  if (all.shift() > WellFits)
  {
    considerOutliers(pairs, mount, mistakes, all);
  }
  for (const Mistake& mistake : mistakes)
  {
    all.consider(
      [&] { return changed(pairs, mistake.undo); }, other, fitsOther + " if " + mistake.what + ": change that.");
  }
  if (!all.words().empty())
  {
    return all.words();
  }
  const auto worst = std::max_element(found.shifts.begin(), found.shifts.end()) - found.shifts.begin();
  return "Pair " + std::to_string(worst + 1) +
         " is the farthest off; check that each pair has the gripper and the target of the same moment, and that the "
         "target is where the mount says.";
}

/// How sure the place is, and what may be wrong with it, each behind a blank.
std::string certaintyWords(const HandEyeCalibration& calibration)
{
  constexpr const char* advice = ": take twenty pairs, the gripper turned by 30 degrees and more about several axes.";
  char sure[96], swapped[256];
  std::snprintf(
    sure, sizeof(sure), " Where it was seen the camera's place is sure to about %.2g mm", calibration.uncertainty);
  std::string words = std::isnan(calibration.uncertainty)
                        ? std::string(" So few places of the gripper do not tell how sure the camera's is") + advice
                        : sure + std::string(calibration.uncertainty > Unsure ? advice : ".");
  if (calibration.targetScale != 1.0)
  {
    words += " The pairs fit much better " + scaleWords(calibration.targetScale);
  }
  const bool onHand = calibration.mount == CameraMount::Hand;
  const double camera = calibration.T_robot_camera.translation().norm();
  const double target = calibration.T_holder_target.translation().norm();
  if (onHand ? camera > Far && target < Near : camera < Near && target > Far)
  {
    std::snprintf(swapped, sizeof(swapped),
      " This puts the camera %.0f mm from the robot's %s and the target %.0f mm from its %s: if that is wrong, both "
      "poses of all pairs are inverse.",
      camera, onHand ? "gripper" : "base", target, onHand ? "base" : "gripper");
    words += swapped;
  }
  return words;
}
}

HandEyeCalibration calibrateHandEye(const std::vector<HandEyePair>& pairs, CameraMount mount)
{
  if (pairs.size() < FewestPairs)
  {
    throw Error("Hand-eye calibration needs 3 pairs of poses or more, better 20, with the gripper turned in different "
                "ways: there are " +
                std::to_string(pairs.size()) + ".");
  }
  std::vector<HandEyePair> exact;
  std::vector<Eigen::Isometry3d> grippers, targets;
  for (const HandEyePair& pair : pairs)
  {
    grippers.push_back(requireRigid(pair.T_base_gripper, "T_base_gripper", exact.size()));
    targets.push_back(requireRigid(pair.T_camera_target, "T_camera_target", exact.size()));
    exact.push_back({ grippers.back(), targets.back() });
  }
  const std::vector<std::size_t> places = placesOf(exact);
  const std::size_t apart = 1 + *std::max_element(places.begin(), places.end());
  if (apart < FewestPairs)
  {
    throw Error("Hand-eye calibration needs 3 places of the gripper or more, better 20: the " +
                std::to_string(pairs.size()) + " pairs have " + std::to_string(apart) + ", over and over.");
  }
  requireTurns(grippers, "gripper", LeastTurn);
  requireTurns(targets, "target", LeastTurn);
  std::optional<HandEyeCalibration> best = bestOf(exact, mount);
  if (!best)
  {
    throw Error("No place of the camera fits the pairs of poses: check that each has the gripper and the target of the "
                "same moment.");
  }
  if (!isSane(best))
  {
    throw Error(
      "No place of the camera fits the pairs of poses. " + describe(*best) + " " + suspicionOf(exact, mount, *best));
  }
  const std::string doubt = cameraUnitDoubt(best->T_robot_camera.translation().norm());
  if (!doubt.empty())
  {
    throw Error(
      "The pairs of poses put " + doubt + ". Set 'units' of the JSON to the poses' unit, or write them in mm.");
  }
  best->targetScale = targetScaleOf(exact, mount);
  best->uncertainty = uncertaintyOf(exact, *best);
  if (best->uncertainty > MostUnsure)
  {
    throw Error("The pairs of poses leave the camera's place open. " + describe(*best));
  }
  return *best;
}

std::string describe(const HandEyeCalibration& calibration)
{
  std::vector<double> sorted = calibration.shifts;
  std::sort(sorted.begin(), sorted.end());
  const auto worst = std::max_element(calibration.shifts.begin(), calibration.shifts.end());
  const bool standsOut = isSane(calibration) && *worst > std::max(StandsOut * sorted[sorted.size() / 2], LeastOutlier);
  char text[200];
  std::snprintf(text, sizeof(text),
    "The target stays within %.2f mm and %.2f degrees (root mean square of %zu pairs; at "
    "most %.2f mm and %.2f degrees).",
    calibration.shift, calibration.turn, calibration.shifts.size(), *worst,
    *std::max_element(calibration.turns.begin(), calibration.turns.end()));
  return text + (isSane(calibration) ? certaintyWords(calibration) : std::string()) +
         (standsOut ? " Pair " + std::to_string(worst - calibration.shifts.begin() + 1) +
                        " stands out: leave it out, or measure it again."
                    : std::string());
}
}
