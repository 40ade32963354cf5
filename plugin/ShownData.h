// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Whether the output, or what it was made of, is a scan.
bool comesFromScan(vtkSMSourceProxy* source, unsigned int port);
/// Whether data of this plugin lie in the scene, not in the part's frame.
bool isInScene(vtkPVDataInformation* data);
