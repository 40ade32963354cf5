# SPDX-License-Identifier: BSD-3-Clause
# Tests written in Python. Exit status 77 means skipped (no data, no display).
find_program(PVPYTHON_EXECUTABLE pvpython)
find_program(PARAVIEW_EXECUTABLE paraview)
set(PPFMEAM_DISPLAY "${PROJECT_SOURCE_DIR}/testing/display.sh") # runs a command on a virtual display of its own

# meam_add_script_test(NAME LABELS COMMAND...): any command, in the environment of this build tree.
function(meam_add_script_test name labels)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES
    LABELS "${labels}" ENVIRONMENT "${PPFMEAM_ENVIRONMENT}" SKIP_RETURN_CODE 77 TIMEOUT 600)
  if("render" IN_LIST labels)
    # Applications with windows wait for each other: theirs is the longest chain, which starts first.
    set_tests_properties(${name} PROPERTIES RESOURCE_LOCK display COST 30)
  endif()
endfunction()

# NAME.py under the plain interpreter and, with ParaView's VTK, under pvpython with the plugin loaded: there all of them in
# one test, for which ParaView starts once; with --long each under the plain interpreter, too. ONLY_PYTHON3 is for what takes
# longer, which has the plain interpreter alone, every day, and starts first: the filters are the same ones. ONLY_RELEASE is for
# what no version of VTK changes, the results of core and the processes of the package: it is left out where the core is
# another build's.
function(meam_add_filter_test name)
  if("ONLY_RELEASE" IN_LIST ARGN AND PPFMEAM_CORE_DIR)
    return()
  endif()
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py")
  set(labels filters)
  if(PPFMEAM_USE_PARAVIEW AND NOT "ONLY_PYTHON3" IN_LIST ARGN)
    list(APPEND labels long)
  endif()
  meam_add_script_test(${name}.python3 "${labels}" "${Python3_EXECUTABLE}" "${script}")
  if("ONLY_PYTHON3" IN_LIST ARGN)
    set_tests_properties(${name}.python3 PROPERTIES COST 10)
  elseif(PPFMEAM_USE_PARAVIEW)
    set_property(GLOBAL APPEND PROPERTY PPFMEAM_PVPYTHON_SCRIPTS "${script}")
  endif()
endfunction()

# NAME.py --long under the plain interpreter: all of what NAME.py alone takes a small part of.
function(meam_add_long_test name labels)
  meam_add_script_test(${name}.long "${labels};long" "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py" --long)
  set_tests_properties(${name}.long PROPERTIES TIMEOUT 3600)
endfunction()

# NAME.py under pvpython with a display of its own; further arguments go to the script.
function(meam_add_pvpython_test name labels)
  meam_add_script_test(${name} "${labels}"
    "${PPFMEAM_DISPLAY}" "${PVPYTHON_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py" ${ARGN})
endfunction()

# NAME.py inside the ParaView application under a virtual display. What the script prints goes to ParaView's
# own window: it has to write to sys.__stderr__ and to end with os._exit(status).
function(meam_add_paraview_test name labels)
  meam_add_script_test(${name} "${labels}"
    "${PPFMEAM_DISPLAY}" "${PARAVIEW_EXECUTABLE}" --dr "--script=${CMAKE_CURRENT_SOURCE_DIR}/${name}.py")
endfunction()
