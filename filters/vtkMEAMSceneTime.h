// SPDX-License-Identifier: BSD-3-Clause
/**
 * Time steps of filters whose first input is not the scene. VTK hands on the time of the first input alone; a part, or
 * a trained model, has none, so that poses would stay those of the first scan. Not wrapped.
 */
#ifndef vtkMEAMSceneTime_h
#define vtkMEAMSceneTime_h

#include <initializer_list>

class vtkInformationVector;

namespace vtkMEAMSceneTime
{
/// For RequestInformation: all outputs get the time steps and the time range of the first of the input ports that has
/// them, and none when no port has.
void announce(vtkInformationVector** inputs, std::initializer_list<int> ports, vtkInformationVector* outputs);
}

#endif
