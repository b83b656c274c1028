include("${TRUNDLE_SDK}/cv_bridge/cmake/extras.cmake")
