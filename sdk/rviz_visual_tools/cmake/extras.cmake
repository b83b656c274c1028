# Eigen of the machine, whose headers those of rviz_visual_tools include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND rviz_visual_tools_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
