# SPDX-License-Identifier: BSD-3-Clause
"""The algorithms: `from ppfmeam.filters import vtkMEAMPoseDetection`."""

# The wrapped classes derive from these modules' classes: they have to be there first.
import vtkmodules.vtkCommonCore  # noqa: F401
import vtkmodules.vtkCommonDataModel  # noqa: F401
import vtkmodules.vtkCommonExecutionModel  # noqa: F401
import vtkmodules.vtkIOCore  # noqa: F401

from .ppfmeamFilters import *  # noqa: F401,F403
