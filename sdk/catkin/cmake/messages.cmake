# Messages, services, actions and configurations: catkin_make has written their headers before CMake runs.
foreach(name add_message_files add_service_files add_action_files generate_messages generate_dynamic_reconfigure_options)
  cmake_language(EVAL CODE "function(${name})\nendfunction()")
endforeach()
