// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

class vtkPVDataInformation;
class vtkSMProxy;
class vtkSMSourceProxy;

/// What a representation shows: an output of a source or filter. Null when it shows no data, as a legend.
struct ShownData
{
  vtkSMSourceProxy* source = nullptr;
  unsigned int port = 0;

  explicit ShownData(vtkSMProxy* representation);

  vtkPVDataInformation* data() const;
};

/// Whether a source is one of this plugin; null is none.
bool isOurs(vtkSMSourceProxy* source);
/// An organized cloud, which is in its sensor's frame.
bool isOrganized(vtkPVDataInformation* data);
/// Whether it reads clouds, which may be points alone.
bool readsClouds(vtkSMSourceProxy* source);

/// The source itself, or the first on its way to the readers, of which an output is of a kind; null: there is none.
vtkSMSourceProxy* firstUpstream(
  vtkSMSourceProxy* source, unsigned int port, const std::function<bool(vtkSMSourceProxy*, unsigned int)>& isKind);
/// Whether the output, or what it was made of, is a scan.
bool comesFromScan(vtkSMSourceProxy* source, unsigned int port);
/// Whether data of this plugin lie in the scene, not in the part's frame.
bool isInScene(vtkPVDataInformation* data);

/// The array that a color map is of, be it shared or of one representation; empty of none.
std::string mappedArray(vtkSMProxy* colors);
