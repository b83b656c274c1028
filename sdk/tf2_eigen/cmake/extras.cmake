# Eigen of the machine, whose headers those of the package include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND ${_trundle_component}_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
