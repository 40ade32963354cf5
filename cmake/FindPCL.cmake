# SPDX-License-Identifier: BSD-3-Clause
# PCL without VTK. PCLConfig.cmake brings plain VTK's targets in beside ParaView's VTK, and two VTKs in
# one process are a crash; so the headers come from an unpacked libpcl-dev (build/deps/pcl, see
# cmake/debian.sh) or from the system, the libraries from the runtime packages. Only modules that link no
# VTK are offered: imported targets PCL::common PCL::kdtree PCL::octree PCL::search PCL::sample_consensus
# PCL::filters PCL::features PCL::registration.
set(unpacked "${PROJECT_SOURCE_DIR}/build/deps/pcl/usr/include")
file(GLOB headers "${unpacked}/pcl-*" "/usr/include/pcl-*" "/usr/local/include/pcl-*") # one folder for each version
list(SORT headers COMPARE NATURAL ORDER DESCENDING)
list(TRANSFORM headers REPLACE "^.*/" "" OUTPUT_VARIABLE suffixes)
find_path(PCL_INCLUDE_DIR pcl/pcl_config.h HINTS "${unpacked}" PATH_SUFFIXES ${suffixes})
set(PCL_VERSION "")
if(PCL_INCLUDE_DIR)
  file(STRINGS "${PCL_INCLUDE_DIR}/pcl/pcl_config.h" line REGEX "define PCL_VERSION_PRETTY")
  string(REGEX MATCH "[0-9]+\\.[0-9]+" PCL_VERSION "${line}")
endif()

find_package(Eigen3 REQUIRED)
find_package(Boost REQUIRED)
set(PCL_depends_common)
set(PCL_depends_kdtree common)
set(PCL_depends_octree common)
set(PCL_depends_search kdtree octree)
set(PCL_depends_sample_consensus search)
set(PCL_depends_filters sample_consensus)
set(PCL_depends_features filters)
set(PCL_depends_registration features)
set(modules common kdtree octree search sample_consensus filters features registration)

foreach(module IN LISTS modules)
  find_library(PCL_${module}_LIBRARY NAMES pcl_${module} libpcl_${module}.so.${PCL_VERSION})
  mark_as_advanced(PCL_${module}_LIBRARY)
  list(APPEND PCL_REQUIRED_LIBRARIES PCL_${module}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PCL REQUIRED_VARS PCL_INCLUDE_DIR ${PCL_REQUIRED_LIBRARIES} VERSION_VAR PCL_VERSION
  REASON_FAILURE_MESSAGE "cmake/debian.sh gets it on Debian 12 and 13")
mark_as_advanced(PCL_INCLUDE_DIR)

if(PCL_FOUND AND NOT TARGET PCL::common)
  foreach(module IN LISTS modules)
    add_library(PCL::${module} UNKNOWN IMPORTED)
    set_target_properties(PCL::${module} PROPERTIES
      IMPORTED_LOCATION "${PCL_${module}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${PCL_INCLUDE_DIR}") # imported: SYSTEM for its users
    target_link_libraries(PCL::${module} INTERFACE Eigen3::Eigen Boost::headers)
    foreach(other IN LISTS PCL_depends_${module})
      target_link_libraries(PCL::${module} INTERFACE PCL::${other})
    endforeach()
  endforeach()
endif()
