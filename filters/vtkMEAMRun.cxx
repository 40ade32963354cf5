// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMRun.h"

#include "vtkVersion.h"

namespace vtkMEAMConversion
{
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
}
