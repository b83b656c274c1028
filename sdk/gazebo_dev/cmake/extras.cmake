# Gazebo's own variables, such as GAZEBO_VERSION, come with it.
include("${TRUNDLE_SDK}/gazebo/cmake/gazebo-config.cmake")
