# SPDX-License-Identifier: BSD-3-Clause
"""The algorithms: `from ppfmeam.filters import vtkMEAMPoseDetection`."""

# The wrapped classes derive from the classes of the modules before them: these have to be there first.
import vtkmodules.vtkCommonCore  # noqa: F401
import vtkmodules.vtkCommonDataModel  # noqa: F401
import vtkmodules.vtkCommonExecutionModel  # noqa: F401
import vtkmodules.vtkIOCore  # noqa: F401

from .ppfmeamDetection import *  # noqa: F401,F403
from .ppfmeamIO import *  # noqa: F401,F403
from .ppfmeamIOImage import *  # noqa: F401,F403
from .ppfmeamPicking import *  # noqa: F401,F403
from .ppfmeamTraining import *  # noqa: F401,F403
