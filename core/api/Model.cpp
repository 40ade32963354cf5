// SPDX-License-Identifier: BSD-3-Clause
#include "base/Bounds.h"
#include "meam.h"
#include "model/file/ModelFile.h"
#include "model/TrainedModel.h"

namespace meam
{
Model::Model(std::shared_ptr<const TrainedModel> trained)
  : Trained(std::move(trained))
{
}

double Model::diameter() const { return this->trained().diameter; }

Eigen::AlignedBox3d Model::bounds() const { return meam::bounds(this->trained().surface.points).cast<double>(); }

Eigen::Vector3d Model::middle() const { return this->trained().visibility->middle().cast<double>(); }

void Model::save(const std::string& path) const { writeModel(path, this->trained()); }

const TrainedModel& Model::trained() const
{
  if (!this->Trained)
  {
    throw Error("The model is empty: train one, or load it from a file.");
  }
  return *this->Trained;
}

CalibratedModel calibrate(const Model& model, const std::vector<JudgedPose>& poses)
{
  TrainedModel calibrated = model.trained();
  const CalibrationReport report = fitModelCalibration(poses, calibrated.calibration);
  calibrated.calibration = report.calibration;
  return { Model(std::make_shared<const TrainedModel>(std::move(calibrated))), report };
}

Model loadModel(const std::string& path) { return Model(std::make_shared<const TrainedModel>(readModel(path))); }
}
