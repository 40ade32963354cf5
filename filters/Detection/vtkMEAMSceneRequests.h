// SPDX-License-Identifier: BSD-3-Clause
/**
 * What filters that take a scene tell and ask the pipeline. VTK hands on the time of the first input alone; a part, or
 * a trained model, has none, so that poses would stay those of the first scan; and it asks for the part of the scene
 * that somebody wants of the output, where edges, planes and poses are found in the whole of it. Not wrapped.
 */
#ifndef vtkMEAMSceneRequests_h
#define vtkMEAMSceneRequests_h

#include <initializer_list>

class vtkInformationVector;

namespace vtkMEAMSceneRequests
{
/// For RequestInformation: all outputs get the time steps and the time range of the first of the input ports that has
/// them, and none when no port has.
void announceTime(vtkInformationVector** inputs, std::initializer_list<int> ports, vtkInformationVector* outputs);
/// For RequestUpdateExtent: of each of the first `ports` inputs the whole extent.
void askForWhole(vtkInformationVector** inputs, int ports);
}

#endif
