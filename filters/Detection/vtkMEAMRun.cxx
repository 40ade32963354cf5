// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMRun.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSetGet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersion.h"

#include <string>

namespace vtkMEAMConversion
{
namespace
{
/// Takes one error of an executive from the console.
class NextError : public vtkCommand
{
public:
  static NextError* New() { return new NextError; }
  void Execute(vtkObject* executive, unsigned long, void*) override { executive->RemoveObserver(this); }
};
}

meam::Progress progressOf(vtkAlgorithm* filter)
{
  return [filter](double share)
  {
    filter->UpdateProgress(share);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220614)
    return !filter->CheckAbort();
#else
    return filter->GetAbortExecute() == 0;
#endif
  };
}

bool isLaterPiece(vtkAlgorithm* filter)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* output = filter->GetOutputInformation(port);
    if (output && output->Has(Pipeline::UPDATE_PIECE_NUMBER()) && output->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0)
    {
      return true;
    }
  }
  return false;
}

int fillInputPort(vtkInformation* info, std::initializer_list<const char*> types, Connections connections)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* type : types)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), connections == Connections::One ? 0 : 1);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), connections == Connections::Any ? 1 : 0);
  return 1;
}

void requestPiece(vtkInformation* request, vtkInformationVector** inputs, int piece, int pieces)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  if (input && request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
  {
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
  }
}

void requireInputs(vtkAlgorithm* filter, std::initializer_list<const char*> names)
{
  std::string missing;
  int port = 0;
  for (const char* name : names)
  {
    if (name && filter->GetNumberOfInputConnections(port) == 0)
    {
      missing += (missing.empty() ? "" : ", ") + std::string(name);
    }
    ++port;
  }
  if (!missing.empty())
  {
    throw meam::Error("Nothing is connected to the input " + missing + ": choose what it gets (change the input).");
  }
}

void requireFileName(const char* name, const char* wanted)
{
  if (!name || !*name)
  {
    throw meam::Error(std::string("No file is given: set FileName to ") + wanted + ".");
  }
}

void reportError(vtkAlgorithm* filter, const char* message, bool failsRequest)
{
  vtkErrorWithObjectMacro(filter, << message);
  if (failsRequest)
  {
    vtkNew<NextError> next;
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, next);
  }
}
}
