# Runs when an installation begins. Adds to NINEBIT_BUILD/install_folders.txt the folders that it will make, which are then
# the uninstall target's to remove: what stands in the prefix before, even if it is empty, is somebody else's.
set(record ${NINEBIT_BUILD}/install_folders.txt)
set(made)
if(EXISTS ${record})
  file(STRINGS ${record} made)
endif()
foreach(folder IN ITEMS bin include/ninebit lib/ninebit lib/cmake/ninebit lib/pkgconfig lib64/cmake/ninebit lib64/pkgconfig
        share/man/man1 share/bash-completion/completions share/zsh/site-functions share/fish/vendor_completions.d
        share/doc/ninebit lib/python3/dist-packages/ninebit)
  set(folder $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${folder})
  while(NOT EXISTS ${folder})
    list(APPEND made ${folder})
    get_filename_component(folder ${folder} DIRECTORY)
  endwhile()
endforeach()
list(REMOVE_DUPLICATES made)
list(JOIN made "\n" made)
file(WRITE ${record} "${made}\n")
