# Bullet of the machine, whose headers those of tf2_bullet include.
find_path(TRUNDLE_BULLET LinearMath/btTransform.h PATH_SUFFIXES bullet)
mark_as_advanced(TRUNDLE_BULLET)
if(TRUNDLE_BULLET)
  list(APPEND tf2_bullet_INCLUDE_DIRS ${TRUNDLE_BULLET})
else()
  file(APPEND "${CMAKE_BINARY_DIR}/trundle_missing.txt" "Bullet\n")
endif()
