// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneRequests.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace vtkMEAMSceneRequests
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkInformation* firstWithTime(vtkInformationVector** inputs, std::initializer_list<int> ports)
{
  for (const int port : ports)
  {
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(connection);
      if (info->Has(Pipeline::TIME_STEPS()) || info->Has(Pipeline::TIME_RANGE()))
      {
        return info;
      }
    }
  }
  return nullptr;
}
}

void announceTime(vtkInformationVector** inputs, std::initializer_list<int> ports, vtkInformationVector* outputs)
{
  vtkInformation* scene = firstWithTime(inputs, ports);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    output->Remove(Pipeline::TIME_STEPS());
    output->Remove(Pipeline::TIME_RANGE());
    if (!scene)
    {
      continue;
    }
    const int steps = scene->Length(Pipeline::TIME_STEPS());
    if (steps > 0)
    {
      double* times = scene->Get(Pipeline::TIME_STEPS());
      output->Set(Pipeline::TIME_STEPS(), times, steps);
      // The pipeline asks again for another time only where there is a range.
      double range[2] = { times[0], times[steps - 1] };
      output->Set(Pipeline::TIME_RANGE(), range, 2);
    }
    if (scene->Has(Pipeline::TIME_RANGE()))
    {
      output->Set(Pipeline::TIME_RANGE(), scene->Get(Pipeline::TIME_RANGE()), 2);
    }
  }
}

void askForWhole(vtkInformationVector** inputs, int ports)
{
  for (int port = 0; port < ports; ++port)
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    if (info && info->Has(Pipeline::WHOLE_EXTENT()))
    {
      info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
}
}
