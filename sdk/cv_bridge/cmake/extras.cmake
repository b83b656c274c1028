# OpenCV of the machine, whose headers those of cv_bridge include.
find_package(OpenCV QUIET)
if(OpenCV_FOUND)
  list(APPEND cv_bridge_INCLUDE_DIRS ${OpenCV_INCLUDE_DIRS})
  list(APPEND cv_bridge_LIBRARIES ${OpenCV_LIBRARIES})
else()
  file(APPEND "${CMAKE_BINARY_DIR}/trundle_missing.txt" "OpenCV\n")
endif()
