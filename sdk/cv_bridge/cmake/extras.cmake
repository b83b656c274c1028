# OpenCV of the machine, whose headers those of the package include.
find_package(OpenCV QUIET)
if(OpenCV_FOUND)
  list(APPEND ${_trundle_component}_INCLUDE_DIRS ${OpenCV_INCLUDE_DIRS})
  list(APPEND ${_trundle_component}_LIBRARIES ${OpenCV_LIBRARIES})
else()
  file(APPEND "${CMAKE_BINARY_DIR}/trundle_missing.txt" "OpenCV\n")
endif()
