# Eigen of the machine, whose headers those of moveit_visual_tools include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND moveit_visual_tools_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
