# Eigen of the machine, whose headers those of moveit_ros_planning_interface include.
find_package(Eigen3 QUIET)
if(EIGEN3_INCLUDE_DIRS)
  list(APPEND moveit_ros_planning_interface_INCLUDE_DIRS ${EIGEN3_INCLUDE_DIRS})
endif()
