# Commands of class_loader for libraries of plugins.

# Hide a library's symbols, so that another library may have classes of the same names; plugins register themselves.
function(class_loader_hide_library_symbols target)
  if(NOT APPLE AND NOT WIN32)
    set(script "${CMAKE_CURRENT_BINARY_DIR}/${target}.hidden")
    file(WRITE "${script}" "{ local: *; };\n")
    target_link_options(${target} PRIVATE "LINKER:--version-script=${script}")
  endif()
endfunction()
