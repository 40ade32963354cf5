# SPDX-License-Identifier: BSD-3-Clause
# What core/ is compiled with, and whoever links its static libraries.
find_package(Eigen3 REQUIRED)
find_package(PCL 1.12 REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs calib3d)
find_package(OpenMesh REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
if(TARGET yaml-cpp::yaml-cpp) # from 0.8 on
  set(YAML_CPP_LIBRARIES yaml-cpp::yaml-cpp)
endif()
find_package(liblzf REQUIRED)
find_package(ZLIB REQUIRED)
find_package(CGAL 5.4 REQUIRED)
find_package(Bullet REQUIRED)
find_package(OpenCASCADE REQUIRED)
find_package(fcl REQUIRED)
