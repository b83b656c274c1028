include("${TRUNDLE_SDK}/kdl_parser/cmake/extras.cmake")
