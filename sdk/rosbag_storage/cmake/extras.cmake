# Boost's libraries that rosbag brings: programs use its program_options without naming it.
foreach(_trundle_library date_time program_options regex)
  _trundle_find_boost(${_trundle_library})
  if(TRUNDLE_BOOST_${_trundle_library})
    list(APPEND ${_trundle_component}_LIBRARIES "${TRUNDLE_BOOST_${_trundle_library}}")
  endif()
endforeach()
