include("${TRUNDLE_SDK}/tf2_eigen/cmake/extras.cmake")
