# catkin's commands for packages that are built with the development kit.
#
# Set by Trundle: TRUNDLE_SDK (this kit's folder), TRUNDLE_KIT (its compiled libraries, and generated headers of messages),
# TRUNDLE_HEADER_PACKAGES (packages without C++ libraries, such as those of messages), TRUNDLE_UNDERLAYS (devel spaces of
# other workspaces), TRUNDLE_BOOST_PREFIX (of a Boost outside the compiler's folders), CATKIN_DEVEL_PREFIX.
cmake_policy(PUSH)
cmake_policy(SET CMP0057 NEW)

set(catkin_FOUND TRUE)
set(CATKIN_DEVEL_PREFIX "${CATKIN_DEVEL_PREFIX}" CACHE PATH "devel space")
option(CATKIN_ENABLE_TESTING "define the targets of tests" OFF)  # ON for `catkin_make tests` and `run_tests`

if(NOT COMMAND catkin_package)
  include("${CMAKE_CURRENT_LIST_DIR}/names.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/components.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/package.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/messages.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/testing.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/plugins.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/ignored.cmake")
endif()
_trundle_name_folders()
list(APPEND CMAKE_LIBRARY_PATH "${CATKIN_DEVEL_PREFIX}/lib")  # for find_library

foreach(component IN LISTS catkin_FIND_COMPONENTS)
  _trundle_use_component(${component})
endforeach()
cmake_policy(POP)
