# SPDX-License-Identifier: BSD-3-Clause
# Debian packages of what the install rules put into the components detect, pick, train, dev, python and paraview. packaging/build.sh
# makes them; what only a package has (copyright, changelog, ParaView's list of plugins) is in the install rules here.
set(PPFMEAM_MAINTAINER "PPFMEAM developers <root@localhost>" CACHE STRING "Maintainer of the Debian packages: Name <address>")
set(debian_revision 1)
set(debian_version "${PROJECT_VERSION}-${debian_revision}")
set(generated "${PROJECT_BINARY_DIR}/packaging")

set(package_detect libppfmeam-detect)
set(package_pick libppfmeam-pick)
set(package_train libppfmeam-train)
set(package_dev libppfmeam-dev)
set(package_python python3-ppfmeam)
set(package_paraview ppfmeam-paraview)
set(components detect pick train dev python paraview)

set(CPACK_COMPONENT_DETECT_DESCRIPTION "6D poses of industrial parts in a bin, detection in C++
Finds the copies of a part in an organized 3D scan with a model trained before:
meam::detect, which holds nothing under the GPL.")
set(CPACK_COMPONENT_PICK_DESCRIPTION "6D poses of industrial parts in a bin, picks in C++
Plans where a gripper can take which of the parts that were found: meam::pick,
which holds nothing under the GPL.")
set(CPACK_COMPONENT_TRAIN_DESCRIPTION "6D poses of industrial parts in a bin, training in C++
Trains the model of a part from its CAD file (STEP, IGES or a mesh) and proposes
grasps of it
(meam::train), and reads images in files (meam::images). Under the GPL: CGAL
is in the one, and Debian's image readers, which the other links, need Poppler.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "6D poses of industrial parts in a bin, C++ headers
Headers and CMake files for find_package(PPFMEAM): meam::detect, meam::images,
meam::pick, meam::train and, with python3-ppfmeam and paraview-dev, the VTK
modules PPFMEAM::Detection, IO, IOImage, Picking and Training.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "6D poses of industrial parts in a bin, Python and command
Finds the copies of an industrial part in a bin: a CAD file and an organized 3D
scan go in, ranked 6D poses come out. The Python module ppfmeam with its VTK
filters, for the VTK that ParaView brings along, and the command ppfmeam.")
set(CPACK_COMPONENT_PARAVIEW_DESCRIPTION "6D poses of industrial parts in a bin, ParaView plugin
The filters, readers and the toolbar of Pose Estimation for ParaView, in the
list of Tools > Manage Plugins.")

# What dpkg-shlibdeps does not find: the plugin's and the module's ParaView it does, with its version.
set(same "(= ${debian_version})")
execute_process(COMMAND "${Python3_EXECUTABLE}" -c
  "import sys; a, b = sys.version_info[:2]; print(f'python3 (>= {a}.{b}), python3 (<< {a}.{b + 1})', end='')"
  OUTPUT_VARIABLE python_depends COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND dpkg-query -W -f "\${source:Upstream-Version}" python3-paraview
  OUTPUT_VARIABLE paraview_version ERROR_QUIET RESULT_VARIABLE unknown)
set(paraview_depends "python3-paraview")
if(unknown EQUAL 0)
  set(paraview_depends "python3-paraview (>= ${paraview_version}), python3-paraview (<< ${paraview_version}.)")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${package_detect} ${same}, ${package_pick} ${same}, ${package_train} ${same}, libeigen3-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "${package_python} ${same}, paraview-dev, cmake")
set(CPACK_DEBIAN_PICK_PACKAGE_DEPENDS "${package_detect} ${same}")
set(CPACK_DEBIAN_TRAIN_PACKAGE_DEPENDS "${package_detect} ${same}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${python_depends}, ${paraview_depends}, python3-numpy, libjs-three, ${package_detect} ${same}, ${package_pick} ${same}, ${package_train} ${same}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "${package_paraview}, python3-mpi4py, xvfb")
set(CPACK_DEBIAN_PARAVIEW_PACKAGE_DEPENDS "${package_python} ${same}")
set(CPACK_DEBIAN_DETECT_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PICK_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_TRAIN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PARAVIEW_PACKAGE_SECTION science)
# Scripts, what makes dpkg run ldconfig, and which package a library is in for dpkg-shlibdeps of others.
set(control "${PROJECT_SOURCE_DIR}/packaging/control")
set(soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
file(WRITE "${generated}/detect/shlibs" "libmeamDetect ${soversion} ${package_detect} ${same}\n")
file(WRITE "${generated}/pick/shlibs" "libmeamPick ${soversion} ${package_pick} ${same}\n")
file(WRITE "${generated}/train/shlibs"
  "libmeamImages ${soversion} ${package_train} ${same}\nlibmeamTrain ${soversion} ${package_train} ${same}\n")
set(CPACK_DEBIAN_DETECT_PACKAGE_CONTROL_EXTRA "${control}/triggers;${generated}/detect/shlibs")
set(CPACK_DEBIAN_PICK_PACKAGE_CONTROL_EXTRA "${control}/triggers;${generated}/pick/shlibs")
set(CPACK_DEBIAN_TRAIN_PACKAGE_CONTROL_EXTRA "${control}/triggers;${generated}/train/shlibs")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${control}/triggers;${control}/postinst;${control}/prerm")

# Copyright and changelog of each package.
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" LICENSE_TEXT)
string(REGEX REPLACE "^[^\n]*\n\n[^\n]*\n\n" "" LICENSE_TEXT "${LICENSE_TEXT}") # title and copyright
string(STRIP "${LICENSE_TEXT}" LICENSE_TEXT)
string(REGEX REPLACE "\n\n" "\n.\n" LICENSE_TEXT "${LICENSE_TEXT}")
string(REGEX REPLACE "\n" "\n " LICENSE_TEXT " ${LICENSE_TEXT}")
set(gpl "Our sources are under the BSD 3-Clause licence. This package is built with parts of CGAL (https://www.cgal.org) that are
 under the GNU General Public License, version 3 or later, so it can be passed on under the GPL 3 only, without any warranty;
 /usr/share/common-licenses/GPL-3 is its text. STEP and IGES files are read by Open CASCADE (https://www.opencascade.com), which is
 linked under the GNU Lesser General Public License 2.1 with its exception for headers; /usr/share/common-licenses/LGPL-2.1.")
set(note_detect "Everything in this package is under the BSD 3-Clause licence; it is built with headers of PCL, FLANN, Boost, Eigen,
 nlohmann's JSON and yaml-cpp, and holds nothing under the GPL.")
set(note_pick "Everything in this package is under the BSD 3-Clause licence; it is built with headers of FCL, OctoMap, Eigen and
 nlohmann's JSON, and holds nothing under the GPL.")
set(note_train "${gpl}")
set(note_dev "The headers are under the BSD 3-Clause licence. What is linked with meam::train, with meam::images (Debian's GDAL
 and Poppler), PPFMEAM::IOImage or PPFMEAM::Training can be passed on under the GPL 3 only (/usr/share/common-licenses/GPL-3).")
set(note_python "${gpl}
 .
 Pages that detect --report writes hold three.js of libjs-three, which is under the MIT licence; its text stands in each page.")
set(note_paraview "${gpl}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${generated}/changelog.Debian" "ppfmeam (${debian_version}) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; CHANGELOG.md of the sources tells what is new.

 -- ${PPFMEAM_MAINTAINER}  ${date}
")
execute_process(COMMAND gzip -9nkf "${generated}/changelog.Debian" COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS components)
  set(COPYRIGHT_NOTE "${note_${component}}")
  configure_file("${PROJECT_SOURCE_DIR}/packaging/copyright.in" "${generated}/${component}/copyright" @ONLY)
  install(FILES "${generated}/${component}/copyright" "${generated}/changelog.Debian.gz"
    DESTINATION share/doc/${package_${component}} COMPONENT ${component} EXCLUDE_FROM_ALL)
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package_${component}})
endforeach()

# Something to begin with: parts, the C++ examples, and a cell.
file(GLOB parts "${PROJECT_SOURCE_DIR}/examples/parts/*.stl")
install(FILES ${parts} DESTINATION share/doc/${package_python}/examples/parts COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples/cpp" "${PROJECT_SOURCE_DIR}/examples/cell"
  DESTINATION share/doc/${package_dev}/examples COMPONENT dev EXCLUDE_FROM_ALL
  PATTERN __pycache__ EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/examples/cell/cell.py" "${PROJECT_SOURCE_DIR}/examples/cell/ros2_node.py"
  DESTINATION share/doc/${package_python}/examples/cell COMPONENT python EXCLUDE_FROM_ALL)
# ParaView lists the plugins that the first paraview.conf names. Debian's 5.13 comes with one, which names a folder for
# those of others; 5.11 comes without one, and finds it beside its program.
set(installed "/usr/lib/${PARAVIEW_PLUGIN_SUBDIR}")
file(GLOB paraview_conf "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/paraview-${ParaView_VERSION_MAJOR}.*/paraview.conf")
if(paraview_conf)
  set(listed /usr/share/paraview/plugins/PPFMEAM)
  file(RELATIVE_PATH plugin "${listed}" "${installed}/PPFMEAM/PPFMEAM.so")
  file(REMOVE "${generated}/PPFMEAM.so")
  file(CREATE_LINK "${plugin}" "${generated}/PPFMEAM.so" SYMBOLIC)
  install(FILES "${generated}/PPFMEAM.so" DESTINATION share/paraview/plugins/PPFMEAM
    COMPONENT paraview EXCLUDE_FROM_ALL)
else()
  file(RELATIVE_PATH plugins /usr/bin "${installed}/ppfmeam.xml")
  file(WRITE "${generated}/paraview.conf" "${plugins}\n")
  install(FILES "${generated}/paraview.conf" DESTINATION bin COMPONENT paraview EXCLUDE_FROM_ALL)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ppfmeam)
set(CPACK_PACKAGE_VENDOR "PPFMEAM developers")
set(CPACK_PACKAGE_CONTACT "${PPFMEAM_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${debian_revision})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${PPFMEAM_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/packaging/staged.cmake")
include(CPack)
