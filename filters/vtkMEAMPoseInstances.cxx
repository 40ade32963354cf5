// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseInstances.h"

#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkMEAMPoseInstances);

namespace
{
constexpr unsigned char RankColors[6][3] = {
  { 220, 30, 30 },   // 1 red
  { 40, 170, 50 },   // 2 green
  { 40, 90, 220 },   // 3 blue
  { 245, 205, 30 },  // 4 yellow
  { 240, 120, 190 }, // 5 pink
  { 150, 150, 150 }, // the others
};

/// The same values for all points or cells of an instance.
void describe(vtkDataSetAttributes* attributes, vtkIdType count, int rank, const meam::Pose& pose)
{
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("Rank");
  ranks->SetNumberOfTuples(count);
  ranks->FillValue(rank);
  attributes->AddArray(ranks);

  for (const auto& [name, value] : { std::pair("Score", pose.score), std::pair("Probability", pose.probability) })
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(name);
    values->SetNumberOfTuples(count);
    values->FillValue(value);
    attributes->AddArray(values);
  }

  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RankColor");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  const unsigned char* color = RankColors[std::min(rank, 6) - 1];
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy_n(color, 3, colors->GetPointer(3 * i));
  }
  attributes->SetScalars(colors);
}
}

vtkMEAMPoseInstances::vtkMEAMPoseInstances() { this->SetNumberOfInputPorts(2); }

int vtkMEAMPoseInstances::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* posesInput = vtkPolyData::GetData(inputVector[0]);
  auto* mesh = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      const meam::Points points = vtkMEAMConversion::toCloud(mesh).points;
      meam::requirePoints(points, "The CAD mesh");
      const meam::Progress progress = vtkMEAMConversion::progressOf(this);
      const meam::Poses poses = vtkMEAMConversion::toPoses(posesInput);
      const std::size_t copies = this->MaximumNumberOfInstances > 0
                                   ? std::min<std::size_t>(poses.size(), this->MaximumNumberOfInstances)
                                   : poses.size();

      vtkDataArray* ranks = posesInput->GetPointData()->GetArray("Rank");
      vtkNew<vtkAppendPolyData> append;
      for (std::size_t k = 0; k < copies; ++k)
      {
        meam::report(progress, static_cast<double>(k) / copies);
        if (poses[k].probability > 0.0 && poses[k].probability < this->MinimumProbability)
        {
          continue;
        }
        const Eigen::Isometry3f T_scene_model = poses[k].T_scene_model.cast<float>();
        vtkNew<vtkPoints> moved;
        moved->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const Eigen::Vector3f point = T_scene_model * points[i];
          moved->SetPoint(static_cast<vtkIdType>(i), point.data());
        }
        vtkNew<vtkPolyData> instance;
        instance->CopyStructure(mesh);
        instance->SetPoints(moved);
        const int place = static_cast<int>(k) + 1;
        const int rank = ranks ? std::max(1, static_cast<int>(ranks->GetComponent(k, 0))) : place;
        describe(instance->GetPointData(), instance->GetNumberOfPoints(), rank, poses[k]);
        describe(instance->GetCellData(), instance->GetNumberOfCells(), rank, poses[k]);
        append->AddInputDataObject(instance);
      }
      if (append->GetNumberOfInputConnections(0) > 0)
      {
        append->Update();
        output->CopyStructure(append->GetOutput());
        output->GetPointData()->ShallowCopy(append->GetOutput()->GetPointData());
        output->GetCellData()->ShallowCopy(append->GetOutput()->GetCellData());
      }
    },
    output);
}

void vtkMEAMPoseInstances::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumNumberOfInstances: " << this->MaximumNumberOfInstances << "\n";
  os << indent << "MinimumProbability: " << this->MinimumProbability << "\n";
}
