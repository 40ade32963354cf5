# SPDX-License-Identifier: BSD-3-Clause
# Bullet's rigid bodies in double precision: CMake's own module finds the libraries in single precision, and Debian's
# BulletConfig.cmake names all of them. Imported target Bullet::Dynamics.
find_path(Bullet_INCLUDE_DIR btBulletDynamicsCommon.h PATH_SUFFIXES bullet)
set(required Bullet_INCLUDE_DIR)
foreach(library IN ITEMS BulletDynamics BulletCollision LinearMath)
  find_library(Bullet_${library}_LIBRARY NAMES ${library}-float64)
  mark_as_advanced(Bullet_${library}_LIBRARY)
  list(APPEND required Bullet_${library}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Bullet REQUIRED_VARS ${required})
mark_as_advanced(Bullet_INCLUDE_DIR)

if(Bullet_FOUND AND NOT TARGET Bullet::Dynamics)
  add_library(Bullet::Dynamics UNKNOWN IMPORTED)
  set_target_properties(Bullet::Dynamics PROPERTIES
    IMPORTED_LOCATION "${Bullet_BulletDynamics_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Bullet_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS BT_USE_DOUBLE_PRECISION
    INTERFACE_LINK_LIBRARIES "${Bullet_BulletCollision_LIBRARY};${Bullet_LinearMath_LIBRARY}")
endif()
