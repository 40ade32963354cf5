# SPDX-License-Identifier: BSD-3-Clause
# Called by cpack when the files are where they are packed from: libraries in /usr/lib need no search path of their own.
file(GLOB_RECURSE libraries "${CPACK_TEMPORARY_DIRECTORY}/*.so" "${CPACK_TEMPORARY_DIRECTORY}/*.so.*")
foreach(library IN LISTS libraries)
  if(NOT IS_SYMLINK "${library}")
    file(RPATH_REMOVE FILE "${library}")
  endif()
endforeach()
