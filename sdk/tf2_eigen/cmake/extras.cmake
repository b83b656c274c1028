# Eigen of the machine, whose headers those of tf2_eigen include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND tf2_eigen_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
