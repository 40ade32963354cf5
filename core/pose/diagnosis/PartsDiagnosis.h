// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/diagnosis/PoseDiagnosis.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meam
{
/// A pose that came out of a search for several types of part, in the scene's own coordinates.
struct FoundPose
{
  int part; ///< index of its type
  int rank; ///< over all types, from 1
  Pose pose;
};

/// What a diagnosis is about.
struct PartDiagnosis
{
  int part;                       ///< index of the type
  bool isChosen;                  ///< false: of all types this one has most evidence there
  std::optional<FoundPose> other; ///< likely pose of another type that has its surface nearest to the point
  Diagnosis diagnosis;
};

/// The diagnosis of several types of part in one scan. A type is searched when a place is first asked about it. Where
/// the type is left open (AnyPart), it is that of the nearest likely pose that has its surface at the point; where
/// there is none, all types are asked about, and the one counts that has most evidence there. Keeps references.
class PartsDiagnosis
{
public:
  static constexpr int AnyPart = -1; // no index of a type

  /// `fit`: as PoseDiagnosis has it.
  PartsDiagnosis(std::vector<const TrainedModel*> models, const SceneInput& scene, const DetectionSettings& detection,
    bool fit = true);

  PartDiagnosis atPose(const Eigen::Isometry3d& T_scene_model, int part = AnyPart, const Progress& progress = {});
  PartDiagnosis ofFound(const FoundPose& found, const Progress& progress = {});
  PartDiagnosis atPoint(const Eigen::Vector3d& point, const std::vector<FoundPose>& found = {}, int part = AnyPart,
    const Progress& progress = {});

private:
  struct Search
  {
    std::unique_ptr<const Scene> scene;
    std::unique_ptr<PoseDiagnosis> diagnosis;
  };
  using Question = std::function<Diagnosis(PoseDiagnosis&, int part, const Progress&)>;

  /// Asks about one type, or about all.
  PartDiagnosis ask(int part, const Progress& progress, const Question& question);
  /// Null where the scan shows nothing.
  PoseDiagnosis* searched(int part, const Progress& progress);

  std::vector<const TrainedModel*> Models;
  const SceneInput& Input;
  const DetectionSettings& Detection;
  bool Fit;
  std::vector<Search> Searches; ///< of each type
};

/// Which of several types of part it is about, and why, in a sentence; empty of one type.
std::string aboutWords(const PartDiagnosis& diagnosis, const std::vector<std::string>& names);
}
