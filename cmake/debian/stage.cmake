# CPack runs this on the folders that become packages: what Debian wants otherwise than `cmake --install` leaves it.
cmake_minimum_required(VERSION 3.22)
# Libraries in /usr/lib find each other there.
file(GLOB libraries ${CPACK_TEMPORARY_DIRECTORY}/libraries/usr/lib/*.so.*)
foreach(library IN LISTS libraries)
  if(NOT IS_SYMLINK ${library})
    file(RPATH_REMOVE FILE ${library})
  endif()
endforeach()
file(GLOB archives ${CPACK_TEMPORARY_DIRECTORY}/development/usr/lib/*.a)
foreach(archive IN LISTS archives)
  execute_process(COMMAND strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${archive}
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB pages ${CPACK_TEMPORARY_DIRECTORY}/program/usr/share/man/man1/*.1)
foreach(page IN LISTS pages)
  execute_process(COMMAND gzip -9n ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# Where Debian's zsh looks.
set(zsh ${CPACK_TEMPORARY_DIRECTORY}/program/usr/share/zsh)
if(EXISTS ${zsh}/site-functions)
  file(RENAME ${zsh}/site-functions ${zsh}/vendor-completions)
endif()
