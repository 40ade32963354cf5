# SPDX-License-Identifier: BSD-3-Clause
# The VTK modules (filters/), their Python package `ppfmeam` and, with ParaView, the plugin.
# The modules are scanned, built and wrapped here and not inside the plugin:
# in ParaView 5.11 a plugin does not Python-wrap the modules it brings along.

# The interpreter that Debian's VTK is built for, whatever comes first on the PATH.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The interpreter VTK was built for")

# What filters/*/vtk.module name. The wrapping tools come with it; VTK 9.3 as in ParaView 5.13 refuses them as components.
set(vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonSystem FiltersCore FiltersSources IOCore vtksys Python)
include(PPFMEAMPythonModules)
if(PPFMEAM_USE_PARAVIEW)
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingServerManager RemotingClientServerStream ProcessXML WrapClientServer)
endif()
# A wheel is for the VTK of this machine: plain VTK where that is installed, else ParaView's, which stands apart.
set(elsewhere "")
if(SKBUILD)
  file(GLOB elsewhere "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/vtk")
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS ${vtk_components} PATHS ${elsewhere})
message(STATUS "VTK ${VTK_VERSION} from ${VTK_DIR}")

# For filters/*/CMakeLists.txt: a module of these classes, of headers and sources that are not wrapped, and one library of the core.
function(ppfmeam_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "CORE" "CLASSES;HEADERS;SOURCES")
  set(module PPFMEAM::${name})
  vtk_module_add_module(${module} CLASSES ${module_CLASSES} NOWRAP_HEADERS ${module_HEADERS} SOURCES ${module_SOURCES})
  vtk_module_link(${module} PRIVATE ${module_CORE})
  vtk_module_compile_options(${module} PRIVATE -Wall -Wextra)
  get_target_property(target ${module} ALIASED_TARGET)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6) # as of core
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER) # ccache keeps nothing of files that are compiled with one
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <algorithm> <string> <vector>
      <vtkDoubleArray.h> <vtkFieldData.h> <vtkInformation.h> <vtkInformationVector.h> <vtkNew.h> <vtkObjectFactory.h>
      <vtkPointData.h> <vtkPolyData.h> <vtkStructuredGrid.h>)
  endif()
endfunction()
set(PPFMEAM_MODULES Detection IO IOImage Picking Training)
list(TRANSFORM PPFMEAM_MODULES REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/filters/\\1/vtk.module" OUTPUT_VARIABLE module_files)
vtk_module_scan(
  MODULE_FILES ${module_files}
  PROVIDES_MODULES modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF)
set_property(GLOBAL PROPERTY _vtk_module_autoinit_include "${VTK_AUTOINIT_INCLUDE}") # for IMPLEMENTABLE modules
vtk_module_build(
  MODULES ${modules}
  LIBRARY_NAME_SUFFIX ""
  PACKAGE PPFMEAMFilters
  INSTALL_EXPORT PPFMEAMFilters
  CMAKE_DESTINATION ${PPFMEAM_CMAKE_DIR}
  LIBRARY_DESTINATION ${CMAKE_INSTALL_LIBDIR}
  TARGETS_COMPONENT python
  HEADERS_DESTINATION include/ppfmeam
  HEADERS_COMPONENT dev)
vtk_module_wrap_python(
  MODULES ${modules}
  PYTHON_PACKAGE ppfmeam
  MODULE_DESTINATION ${PPFMEAM_PYTHON_DIR}
  LIBRARY_DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF)

# meam.h and picks.h for Python.
set(PYBIND11_NOPYTHON ON) # the interpreter is known
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED)
set(bindings "${PROJECT_SOURCE_DIR}/core/python")
Python3_add_library(ppfmeamBindings MODULE WITH_SOABI
  "${bindings}/Detection.cpp" "${bindings}/Module.cpp" "${bindings}/Picks.cpp")
target_link_libraries(ppfmeamBindings PRIVATE pybind11::headers meam::detect meam::images meam::pick meam::train)
target_compile_options(ppfmeamBindings PRIVATE -Wall -Wextra -Wno-array-bounds -Wno-maybe-uninitialized # as of core
  $<$<CONFIG:Release>:-O1>) # what takes time is in the libraries; compiled in two thirds of the time
set_target_properties(ppfmeamBindings PROPERTIES
  OUTPUT_NAME _core CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/${PPFMEAM_PYTHON_DIR}/ppfmeam"
  INSTALL_RPATH "$<IF:$<BOOL:${SKBUILD}>,$ORIGIN,$ORIGIN/../../..>")
install(TARGETS ppfmeamBindings LIBRARY DESTINATION "${PPFMEAM_PYTHON_DIR}/ppfmeam" COMPONENT python)

# The hand-written part of the Python package, its sub-commands, and the command that runs them.
set(package_files __init__.py __main__.py api.py asked.py bop.py cell.py cellpicture.py choices.json choices.py dataset.py evaluation.py
  filters.py finding.py inputs.py instances.py lines.py picking.py picture.py progress.py regions.py scripting.py simulation.py)
set(command_files __init__.py batch.py calibrate.py cell.py detect.py evaluate.py hand_eye.py pick.py simulate.py train.py why.py)
set(batch_files __init__.py __main__.py apart.py journal.py pages.py parts.py progress.py ranks.py run.py scans.py table.py
  watch.py)
set(report_files __init__.py content.py judged.js judged.py listing.py markup.py notebook.py outlines.py page.html page.js page.py
  projection.py told.py writer.py)
set(package_destination "${PROJECT_BINARY_DIR}/${PPFMEAM_PYTHON_DIR}/ppfmeam")
set(package_copies)
function(ppfmeam_copy folder) # files of filters/ppfmeam/FOLDER, to the build tree and to the installed one
  list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/filters/ppfmeam${folder}/" OUTPUT_VARIABLE sources)
  list(TRANSFORM ARGN PREPEND "${package_destination}${folder}/" OUTPUT_VARIABLE copies)
  add_custom_command(OUTPUT ${copies}
    COMMAND ${CMAKE_COMMAND} -E make_directory "${package_destination}${folder}"
    COMMAND ${CMAKE_COMMAND} -E copy ${sources} "${package_destination}${folder}"
    DEPENDS ${sources})
  install(FILES ${sources} DESTINATION ${PPFMEAM_PYTHON_DIR}/ppfmeam${folder} COMPONENT python)
  set(package_copies ${package_copies} ${copies} PARENT_SCOPE)
endfunction()
ppfmeam_copy("" ${package_files})
ppfmeam_copy(/commands ${command_files})
ppfmeam_copy(/batch ${batch_files})
ppfmeam_copy(/report ${report_files})
configure_file("${PROJECT_SOURCE_DIR}/filters/ppfmeam/version.py.in" "${package_destination}/version.py" @ONLY)
install(FILES "${package_destination}/version.py" DESTINATION ${PPFMEAM_PYTHON_DIR}/ppfmeam COMPONENT python)
if(NOT SKBUILD) # pip makes it
  install(PROGRAMS "${PROJECT_SOURCE_DIR}/filters/command/ppfmeam" DESTINATION bin COMPONENT python)
endif()
add_custom_target(ppfmeamPackage ALL DEPENDS ${package_copies})

list(TRANSFORM PPFMEAM_MODULES REPLACE "(.+)" "ppfmeam\\1Python" OUTPUT_VARIABLE python_modules)
set_target_properties(${python_modules} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
add_dependencies(runtime ${python_modules} ppfmeamBindings ppfmeamPackage)

if(PPFMEAM_USE_PARAVIEW)
  paraview_plugin_scan(
    PLUGIN_FILES "${PROJECT_SOURCE_DIR}/plugin/paraview.plugin"
    PROVIDES_PLUGINS plugins
    REQUIRES_MODULES plugin_modules
    ENABLE_BY_DEFAULT ON
    HIDE_PLUGINS_FROM_CACHE ON)
  paraview_plugin_build(
    PLUGINS ${plugins}
    LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
    PLUGINS_FILE_NAME "ppfmeam.xml"
    PLUGINS_COMPONENT paraview
    TARGET_COMPONENT paraview
    INSTALL_HEADERS OFF)
  add_dependencies(runtime ${plugins})
  list(TRANSFORM PPFMEAM_MODULES REPLACE "(.+)" "ppfmeam\\1CS" OUTPUT_VARIABLE client_server)
  set_target_properties(${client_server} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
endif()

# The environment that finds all of it in the build tree, for the tests and for `source build/release/env.sh`.
set(PPFMEAM_ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/${PPFMEAM_PYTHON_DIR}")
if(PPFMEAM_USE_PARAVIEW)
  list(APPEND PPFMEAM_ENVIRONMENT "PV_PLUGIN_PATH=${PROJECT_BINARY_DIR}/lib/${PARAVIEW_PLUGIN_SUBDIR}")
else()
  # A VTK that is unpacked and not installed is found through the environment alone.
  get_filename_component(vtk_libraries "${VTK_DIR}/../.." ABSOLUTE)
  string(APPEND PPFMEAM_ENVIRONMENT ":${VTK_PREFIX_PATH}/${VTK_PYTHONPATH}")
  list(APPEND PPFMEAM_ENVIRONMENT "LD_LIBRARY_PATH=${vtk_libraries}")
endif()
set(env_lines "")
foreach(entry IN LISTS PPFMEAM_ENVIRONMENT)
  string(REGEX REPLACE "^([A-Z_]+)=(.*)$" "export \\1='\\2'\"\${\\1:+:\$\\1}\"\n" line "${entry}")
  string(APPEND env_lines "${line}")
endforeach()
file(WRITE "${PROJECT_BINARY_DIR}/env.sh" "${env_lines}")
