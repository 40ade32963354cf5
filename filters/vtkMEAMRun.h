// SPDX-License-Identifier: BSD-3-Clause
/**
 * What every filter's RequestData shares: progress and abort as the core asks for them, and errors on VTK's channel.
 * Not wrapped.
 */
#ifndef vtkMEAMRun_h
#define vtkMEAMRun_h

#include "base/Error.h"

#include "vtkAlgorithm.h"
#include "vtkObject.h"
#include "vtkSetGet.h"

namespace vtkMEAMConversion
{
/// Progress and abort of a filter as the core asks for them.
meam::Progress progressOf(vtkAlgorithm* filter);
}

/**
 * The body of a RequestData: what the core throws becomes an error on VTK's channel with nothing in the
 * output, a wish to stop becomes an empty output. `work` is a callable, `outputs...` the data objects to
 * empty when it fails.
 */
template <typename Work, typename... Outputs>
int vtkMEAMRun(vtkAlgorithm* self, Work&& work, Outputs*... outputs)
{
  try
  {
    work();
    return 1;
  }
  catch (const meam::Aborted&)
  {
    (outputs->Initialize(), ...);
    return 1;
  }
  catch (const std::exception& error)
  {
    (outputs->Initialize(), ...);
    vtkErrorWithObjectMacro(self, << error.what());
    return 0;
  }
}

#endif
