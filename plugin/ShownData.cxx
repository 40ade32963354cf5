// SPDX-License-Identifier: BSD-3-Clause
#include "ShownData.h"

#include "vtkDataObject.h"
#include "vtkPVDataInformation.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

#include <QString>

#include <cstring>

ShownData::ShownData(vtkSMProxy* representation)
{
  if (representation && representation->GetProperty("Input"))
  {
    const vtkSMPropertyHelper input(representation, "Input");
    if (input.GetNumberOfElements() == 1)
    {
      this->source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0));
      this->port = input.GetOutputPort(0);
    }
  }
}

vtkPVDataInformation* ShownData::data() const { return this->source->GetDataInformation(this->port); }

bool isOurs(vtkSMSourceProxy* source)
{
  const char* name = source ? source->GetVTKClassName() : nullptr;
  return name && std::strncmp(name, "vtkMEAM", std::strlen("vtkMEAM")) == 0;
}

bool isOrganized(vtkPVDataInformation* data)
{
  const int* extent = data->GetExtent();
  return data->DataSetTypeIsA("vtkStructuredGrid") && extent[1] > extent[0] && extent[3] > extent[2] &&
         extent[5] == extent[4];
}

bool readsClouds(vtkSMSourceProxy* source)
{
  const char* name = source->GetVTKClassName();
  const auto isOne = [name](const char* reader) { return std::strcmp(name, reader) == 0; };
  return name && (isOne("vtkMEAMPCDReader") || isOne("vtkMEAMPLYReader") || isOne("vtkMEAMXYZReader"));
}

vtkSMSourceProxy* firstUpstream(
  vtkSMSourceProxy* source, unsigned int port, const std::function<bool(vtkSMSourceProxy*, unsigned int)>& isKind)
{
  if (isKind(source, port))
  {
    return source;
  }
  auto iterator = vtkSmartPointer<vtkSMPropertyIterator>::Take(source->NewPropertyIterator());
  for (iterator->Begin(); !iterator->IsAtEnd(); iterator->Next())
  {
    auto* input = vtkSMInputProperty::SafeDownCast(iterator->GetProperty());
    for (unsigned int k = 0; input && k < input->GetNumberOfProxies(); ++k)
    {
      auto* producer = vtkSMSourceProxy::SafeDownCast(input->GetProxy(k));
      if (auto* found = producer ? firstUpstream(producer, input->GetOutputPortForConnection(k), isKind) : nullptr)
      {
        return found;
      }
    }
  }
  return nullptr;
}

bool comesFromScan(vtkSMSourceProxy* source, unsigned int port)
{
  const auto isScan = [](vtkSMSourceProxy* from, unsigned int output)
  { return readsClouds(from) || isOrganized(from->GetDataInformation(output)); };
  return firstUpstream(source, port, isScan) != nullptr;
}

bool isInScene(vtkPVDataInformation* data)
{
  const auto has = [&](const char* name) { return data->GetArrayInformation(name, vtkDataObject::POINT) != nullptr; };
  const bool areGrasps = has("FreeTurn"); // on the part
  return isOrganized(data) || (has("Transform") && !areGrasps) || has("RankColor") || has("EdgeSource");
}

std::string mappedArray(vtkSMProxy* colors)
{
  const char* name = colors ? colors->GetSessionProxyManager()->GetProxyName("lookup_tables", colors) : nullptr;
  const QString array = QString(name).section('.', 0, 0); // Separate_123_Rank.PVLookupTable
  return (array.startsWith("Separate_") ? array.section('_', 2) : array).toStdString();
}
