# Eigen of the machine, whose headers those of geometric_shapes include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND geometric_shapes_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
