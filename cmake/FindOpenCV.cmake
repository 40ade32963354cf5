# SPDX-License-Identifier: BSD-3-Clause
# OpenCV's small modules alone: OpenCVConfig.cmake is part of libopencv-dev, which installs every module
# (Qt, plain VTK, 450 MB). Imported targets opencv_core, opencv_imgproc, ... for the COMPONENTS asked for.
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  find_library(OpenCV_${module}_LIBRARY NAMES opencv_${module})
  mark_as_advanced(OpenCV_${module}_LIBRARY)
  list(APPEND OpenCV_REQUIRED_LIBRARIES OpenCV_${module}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR ${OpenCV_REQUIRED_LIBRARIES})
mark_as_advanced(OpenCV_INCLUDE_DIR)

if(OpenCV_FOUND)
  foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
    if(NOT TARGET opencv_${module})
      add_library(opencv_${module} UNKNOWN IMPORTED)
      set_target_properties(opencv_${module} PROPERTIES
        IMPORTED_LOCATION "${OpenCV_${module}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
