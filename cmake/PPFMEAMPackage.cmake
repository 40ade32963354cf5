# SPDX-License-Identifier: BSD-3-Clause
# find_package(PPFMEAM) in the installed tree, wherever that is moved.
include(CMakePackageConfigHelpers)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/PPFMEAMConfig.cmake.in" "${PROJECT_BINARY_DIR}/PPFMEAMConfig.cmake"
  INSTALL_DESTINATION ${PPFMEAM_CMAKE_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/PPFMEAMConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/PPFMEAMConfig.cmake" "${PROJECT_BINARY_DIR}/PPFMEAMConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/PPFMEAMPythonModules.cmake"
  DESTINATION ${PPFMEAM_CMAKE_DIR} COMPONENT dev)
