# Commands for Python and tools, which are without effect here: Python runs as it is.
set(CATKIN_IGNORED
  catkin_python_setup catkin_metapackage catkin_workspace catkin_add_env_hooks catkin_download_test_data
  catkin_run_tests_target roslaunch_add_file_check roslint_cpp roslint_python roslint_custom roslint_add_test
  genmsg_generate add_rosdoc rosbuild_init)
foreach(name IN LISTS CATKIN_IGNORED)
  if(NOT COMMAND ${name})
    cmake_language(EVAL CODE "function(${name})\nendfunction()")
  endif()
endforeach()
