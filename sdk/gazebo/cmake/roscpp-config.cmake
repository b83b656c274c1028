# The kit gives roscpp with Gazebo, where CMake runs alone.
include("${CMAKE_CURRENT_LIST_DIR}/gazebo-config.cmake")
