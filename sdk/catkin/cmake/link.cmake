# All libraries of the kit at the end of each link: those are taken whose symbols are still missing. In ROS a plugin
# finds the symbols of a library that its CMakeLists.txt forgets in the program that loads it.
if(NOT APPLE AND NOT WIN32 AND NOT "${CMAKE_CXX_STANDARD_LIBRARIES}" MATCHES "as-needed")
  file(GLOB _trundle_files "${TRUNDLE_KIT}/lib/*.so")
  list(TRANSFORM _trundle_files REPLACE "(.+)" " \"\\1\"")
  list(JOIN _trundle_files "" _trundle_files)
  if(EXISTS "${TRUNDLE_KIT}/lib/libtrundle_cxx.so")
    string(APPEND CMAKE_CXX_STANDARD_LIBRARIES " -nostdlib++")  # zig.cmake has another
  endif()
  string(APPEND CMAKE_CXX_STANDARD_LIBRARIES
    " -Wl,--as-needed${_trundle_files} -Wl,-rpath,\"${TRUNDLE_KIT}/lib\"")
endif()
