# SPDX-License-Identifier: BSD-3-Clause
# Open CASCADE's readers of STEP and IGES and its triangulation: OpenCASCADEConfig.cmake gives definitions of its own to
# all that is compiled beside. Imported target OpenCASCADE::DataExchange. The readers are named otherwise from 7.8 on.
find_path(OpenCASCADE_INCLUDE_DIR STEPControl_Reader.hxx PATH_SUFFIXES opencascade)
set(required OpenCASCADE_INCLUDE_DIR)
set(libraries)
foreach(toolkit IN ITEMS TKSTEP TKSTEPBase TKIGES TKXSBase TKMesh TKShHealing TKTopAlgo TKBRep TKG3d TKMath TKernel)
  string(REGEX REPLACE "^TK(STEP|IGES).*" "TKDE\\1" later "${toolkit}")
  find_library(OpenCASCADE_${toolkit}_LIBRARY NAMES ${toolkit} ${later})
  mark_as_advanced(OpenCASCADE_${toolkit}_LIBRARY)
  list(APPEND required OpenCASCADE_${toolkit}_LIBRARY)
  list(APPEND libraries "${OpenCASCADE_${toolkit}_LIBRARY}")
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCASCADE REQUIRED_VARS ${required})
mark_as_advanced(OpenCASCADE_INCLUDE_DIR)

if(OpenCASCADE_FOUND AND NOT TARGET OpenCASCADE::DataExchange)
  add_library(OpenCASCADE::DataExchange INTERFACE IMPORTED)
  list(REMOVE_DUPLICATES libraries)
  set_target_properties(OpenCASCADE::DataExchange PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${OpenCASCADE_INCLUDE_DIR}" # imported: SYSTEM for its users
    INTERFACE_LINK_LIBRARIES "${libraries}")
endif()
