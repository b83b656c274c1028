# Eigen of the machine, whose headers those of tf_conversions include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND tf_conversions_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
