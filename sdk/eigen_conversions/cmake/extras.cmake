# Eigen of the machine, whose headers those of eigen_conversions include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND eigen_conversions_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
