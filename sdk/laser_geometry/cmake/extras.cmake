# Eigen of the machine, which the original's header includes; without it there is none.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND laser_geometry_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
