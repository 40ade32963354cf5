# SPDX-License-Identifier: BSD-3-Clause
# Debian 13's ParaView 5.13 installs vtkCommonCore.cpython-313-x86_64-linux-gnu.so and so on, while its CMake files name
# vtkCommonCore.so, and find_package() stops there. Nobody links Python modules, so their files need not be looked at:
# CMake looks at none of an XCFramework, which is what this says that they are. To include before find_package(ParaView)
# or of ParaView's VTK; CMake before 3.28, as on Debian 12, takes no notice.
file(GLOB _ppfmeam_files "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/ParaViewPython*-targets.cmake"
  "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/vtk/VTKPython-targets.cmake")
foreach(_ppfmeam_file IN LISTS _ppfmeam_files)
  file(STRINGS "${_ppfmeam_file}" _ppfmeam_modules REGEX "^add_library\\(.* MODULE IMPORTED\\)")
  list(TRANSFORM _ppfmeam_modules REPLACE "^add_library\\((.*) MODULE IMPORTED\\)" "\\1")
  foreach(_ppfmeam_module IN LISTS _ppfmeam_modules)
    set("_cmake_import_check_xcframework_for_${_ppfmeam_module}" "${CMAKE_CURRENT_LIST_DIR}")
  endforeach()
endforeach()
unset(_ppfmeam_files)
unset(_ppfmeam_modules)
