# The target ninebit_installable builds everything that `cmake --install` copies out of the build folder. An installation
# begins with a check that all of it is there, so that it is whole or does not begin.
add_custom_target(ninebit_installable)

# What is installed of a target, or a generated FILE of one.
function(ninebit_installable target)
  set(file $<TARGET_FILE:${target}>)
  if(ARGC GREATER 1)
    set(file ${ARGV1})
  endif()
  set_property(TARGET ninebit_installable APPEND PROPERTY NINEBIT_FILES ${file})
  add_dependencies(ninebit_installable ${target})
endfunction()

install(CODE "
  set(files \"$<TARGET_GENEX_EVAL:ninebit_installable,$<TARGET_PROPERTY:ninebit_installable,NINEBIT_FILES>>\")
  set(missing)
  foreach(file IN LISTS files)
    if(NOT EXISTS \"\${file}\")
      get_filename_component(name \"\${file}\" NAME)
      string(APPEND missing \" \${name}\")
    endif()
  endforeach()
  if(missing)
    message(FATAL_ERROR \"Nothing was installed, as this is not built yet:\${missing}. \"
                        \"Run first: cmake --build ${PROJECT_BINARY_DIR} --target ninebit_installable\")
  endif()
")
