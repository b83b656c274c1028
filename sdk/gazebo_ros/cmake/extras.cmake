# It depends on gazebo_dev.
include("${TRUNDLE_SDK}/gazebo_dev/cmake/extras.cmake")
