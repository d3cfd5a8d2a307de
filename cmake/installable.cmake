# The target ninebit_installable builds everything that `cmake --install` copies out of the build folder. An installation
# begins with a check that all of it is there, so that it is whole or does not begin. Each rule belongs to a component, of
# which cmake/packages.cmake makes a Debian package: program, libraries, development (the default), python, doc, gl; of gl32,
# the layer for programs of 32 bits, one of the architecture i386.
add_custom_target(ninebit_installable)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

# What is installed of a target, or a generated FILE of one: ninebit_installable(TARGET [FILE path] [COMPONENT name])
function(ninebit_installable target)
  cmake_parse_arguments(PART "" "FILE;COMPONENT" "" ${ARGN})
  if(NOT PART_COMPONENT)
    set(PART_COMPONENT ${CMAKE_INSTALL_DEFAULT_COMPONENT_NAME})
  endif()
  if(NOT PART_FILE)
    set(PART_FILE $<TARGET_FILE:${target}>)
  endif()
  set_property(TARGET ninebit_installable APPEND PROPERTY NINEBIT_FILES ${PART_COMPONENT}:${PART_FILE})
  add_dependencies(ninebit_installable ${target})
endfunction()

# Installs a library, whose target is a part of the CMake package's file EXPORT.
function(ninebit_install_library target export)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY")
    ninebit_installable(${target} COMPONENT libraries)
  else()
    ninebit_installable(${target})
  endif()
  install(TARGETS ${target} EXPORT ${export}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# Runs before the first file is copied. Of folders that uninstall.cmake may remove, it notes those that are not there yet.
install(CODE "
  set(files \"$<TARGET_GENEX_EVAL:ninebit_installable,$<TARGET_PROPERTY:ninebit_installable,NINEBIT_FILES>>\")
  set(missing)
  foreach(file IN LISTS files)
    string(REGEX MATCH \"^[a-z0-9]+\" component \"\${file}\")
    string(REGEX REPLACE \"^[a-z0-9]+:\" \"\" file \"\${file}\")
    if((NOT CMAKE_INSTALL_COMPONENT OR CMAKE_INSTALL_COMPONENT STREQUAL component) AND NOT EXISTS \"\${file}\")
      get_filename_component(name \"\${file}\" NAME)
      list(APPEND missing \"\${name}\")
    endif()
  endforeach()
  if(missing)
    list(LENGTH missing count)
    list(GET missing 0 first)
    # Text that begins with a blank stays on one line.
    message(FATAL_ERROR \" Nothing was installed: files that are not built yet: \${count}, the first \${first}; \"
                        \"run first: cmake --build ${PROJECT_BINARY_DIR} --target ninebit_installable\")
  endif()
  if(NOT CMAKE_INSTALL_COMPONENT)
    set(NINEBIT_BUILD ${PROJECT_BINARY_DIR})
    include(${CMAKE_CURRENT_LIST_DIR}/new_folders.cmake)
  endif()
" ALL_COMPONENTS)
