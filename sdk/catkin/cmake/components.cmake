# Packages that others need: of the kit, of the workspace, or of its underlays.

include("${CMAKE_CURRENT_LIST_DIR}/libraries.cmake")

# Folders of headers of the whole kit: packages use headers of others without naming them, as in /opt/ros.
file(GLOB _TRUNDLE_INCLUDES LIST_DIRECTORIES TRUE "${TRUNDLE_SDK}/*/include")
list(APPEND _TRUNDLE_INCLUDES "${TRUNDLE_KIT}/include" "${CATKIN_DEVEL_PREFIX}/include")
if(TRUNDLE_BOOST_PREFIX)
  list(APPEND _TRUNDLE_INCLUDES "${TRUNDLE_BOOST_PREFIX}/include")
endif()

find_package(Threads QUIET)

# Boost's libraries that roscpp brings; those that are not installed are left out, as most programs need none.
include("${CMAKE_CURRENT_LIST_DIR}/boost_library.cmake")
set(_TRUNDLE_BOOST_LIBRARIES "")
foreach(_trundle_library thread chrono filesystem system)
  _trundle_find_boost(${_trundle_library})
  if(TRUNDLE_BOOST_${_trundle_library})
    list(APPEND _TRUNDLE_BOOST_LIBRARIES "${TRUNDLE_BOOST_${_trundle_library}}")
  endif()
endforeach()

# Find a package's folders and libraries.
macro(_trundle_read_component component)
  set(${component}_FOUND TRUE)
  set(${component}_INCLUDE_DIRS ${_TRUNDLE_INCLUDES})
  set(${component}_LIBRARIES "")
  set(${component}_EXPORTED_TARGETS "")
  if(EXISTS "${CATKIN_DEVEL_PREFIX}/share/${component}/cmake/${component}Config.cmake")
    include("${CATKIN_DEVEL_PREFIX}/share/${component}/cmake/${component}Config.cmake")
  elseif(DEFINED _TRUNDLE_LIBRARIES_${component})
    foreach(_trundle_library IN LISTS _TRUNDLE_LIBRARIES_${component})
      set(_trundle_file "${TRUNDLE_KIT}/lib/lib${_trundle_library}${CMAKE_SHARED_LIBRARY_SUFFIX}")
      if(EXISTS "${_trundle_file}")  # some need libraries of the machine that were not there
        list(APPEND ${component}_LIBRARIES "${_trundle_file}")
      endif()
    endforeach()
    list(APPEND ${component}_LIBRARIES ${_TRUNDLE_BOOST_LIBRARIES} Threads::Threads)
    # Libraries of the machine that its headers need.
    set(_trundle_component ${component})
    include("${TRUNDLE_SDK}/${component}/cmake/extras.cmake" OPTIONAL)
  elseif(NOT IS_DIRECTORY "${TRUNDLE_SDK}/${component}" AND NOT ${component} IN_LIST TRUNDLE_HEADER_PACKAGES)
    set(${component}_FOUND FALSE)
    foreach(_trundle_prefix IN LISTS TRUNDLE_UNDERLAYS)
      if(EXISTS "${_trundle_prefix}/share/${component}/cmake/${component}Config.cmake")
        include("${_trundle_prefix}/share/${component}/cmake/${component}Config.cmake")
        set(${component}_FOUND TRUE)
      endif()
    endforeach()
    if(NOT ${component}_FOUND)
      file(APPEND "${CMAKE_BINARY_DIR}/trundle_missing.txt" "${component}\n")
    endif()
  endif()
endmacro()

# Find a package as a component of catkin.
macro(_trundle_use_component component)
  set(catkin_LIBRARY_DIRS "${TRUNDLE_KIT}/lib" "${CATKIN_DEVEL_PREFIX}/lib")
  _trundle_read_component(${component})
  # Never empty, as add_dependencies(program ${catkin_EXPORTED_TARGETS}) needs a second argument.
  list(APPEND ${component}_EXPORTED_TARGETS ${component}_generate_messages_cpp)
  foreach(_trundle_kind INCLUDE_DIRS LIBRARIES EXPORTED_TARGETS)
    list(APPEND catkin_${_trundle_kind} ${${component}_${_trundle_kind}})
    if(catkin_${_trundle_kind})
      list(REMOVE_DUPLICATES catkin_${_trundle_kind})
    endif()
  endforeach()
  # Targets of messages that are generated elsewhere, named in add_dependencies.
  foreach(_trundle_kind generate_messages_cpp gencpp gencfg generate_messages)
    if(NOT TARGET ${component}_${_trundle_kind})
      add_custom_target(${component}_${_trundle_kind})
    endif()
  endforeach()
endmacro()
