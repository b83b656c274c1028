include("${TRUNDLE_SDK}/rosbag_storage/cmake/extras.cmake")
