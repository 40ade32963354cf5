// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSensorAlgorithm.h"

void vtkMEAMSensorAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* names[] = { "Automatic", "Orthographic", "Perspective" };
  os << indent << "Projection: " << names[this->Projection] << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1] << " "
     << this->ViewDirection[2] << "\n";
  os << indent << "SensorPosition: " << this->SensorPosition[0] << " " << this->SensorPosition[1] << " "
     << this->SensorPosition[2] << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
