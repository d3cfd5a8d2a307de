# What `cmake --install` leaves: headers, libraries, the program with its manual and completions, and the files by which
# CMake and pkg-config find them.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ninebit)

set(components combiner)
set(rooms numerics combiner texture_shader language)
set(without PATTERN *json.h EXCLUDE)  # they are of another library
if(NOT NINEBIT_BUILD_TESTS)           # nor is this in a build of the combiners alone
  list(APPEND without PATTERN register_log.h EXCLUDE PATTERN source_code.h EXCLUDE PATTERN smt_lib.h EXCLUDE)
endif()
if(NOT NINEBIT_COMBINER_ONLY)
  list(APPEND components json capi raster ninebit)
  list(APPEND rooms capi raster scene image frame shadow effect study)
  set(without)
  install(EXPORT ninebit-glm NAMESPACE ninebit:: DESTINATION ${package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/include/ninebit/ninebit.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ninebit)
endif()
foreach(room IN LISTS rooms)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ninebit/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ninebit
          FILES_MATCHING PATTERN *.h PATTERN *.inl ${without})
endforeach()

# The two C99 files that emulators copy.
install(FILES ${PROJECT_SOURCE_DIR}/src/combiner/c99/ninebit_combiner.h ${PROJECT_SOURCE_DIR}/src/combiner/c99/ninebit_combiner.c
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ninebit/c99)

# --- CMake packages: one file of targets for each component and kind of library.
foreach(component IN LISTS components)
  install(EXPORT ninebit-${component}-static NAMESPACE ninebit:: DESTINATION ${package_dir})
  if(NINEBIT_SHARED)
    install(EXPORT ninebit-${component}-shared NAMESPACE ninebit:: DESTINATION ${package_dir})
  endif()
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ninebit-config.cmake.in ninebit-config.cmake
                              INSTALL_DESTINATION ${package_dir} NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(ninebit-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ninebit-config.cmake ${PROJECT_BINARY_DIR}/ninebit-config-version.cmake
        DESTINATION ${package_dir})

# --- pkg-config. The prefix is told from the file's own place, so that the tree may be moved.
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /prefix/${pkgconfig_dir} /prefix)
# ninebit_pkgconfig(NAME DESCRIPTION LIBRARY ... [REQUIRES ...] [PRIVATE_LIBS ...] [PRIVATE_REQUIRES ...])
function(ninebit_pkgconfig name description)
  cmake_parse_arguments(PC "" "" "LIBS;REQUIRES;STATIC_LIBS;STATIC_REQUIRES" ${ARGN})
  foreach(list IN ITEMS LIBS REQUIRES STATIC_LIBS STATIC_REQUIRES)
    list(JOIN PC_${list} " " PC_${list})
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/ninebit.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_dir})
endfunction()
ninebit_pkgconfig(ninebit-combiner "GeForce 2 register combiners to the bit" LIBS -lninebit_combiner
                  STATIC_REQUIRES libhwy STATIC_LIBS -lstdc++ -lm)
if(NOT NINEBIT_COMBINER_ONLY)
  set(tbb)
  if(NINEBIT_THREADS)
    set(tbb tbb)
  endif()
  ninebit_pkgconfig(ninebit-json "Register combiner programs as JSON" LIBS -lninebit_json REQUIRES ninebit-combiner)
  ninebit_pkgconfig(ninebit-capi "GeForce 2 register combiners to the bit, for C" LIBS -lninebit_capi
                    STATIC_REQUIRES ninebit-json)
  ninebit_pkgconfig(ninebit-raster "A rasterizer with register combiners" LIBS -lninebit_raster
                    REQUIRES ninebit-combiner STATIC_LIBS -lninebit_parallel STATIC_REQUIRES ${tbb} libhwy)
  ninebit_pkgconfig(
    ninebit ${PROJECT_DESCRIPTION} LIBS -lninebit REQUIRES ninebit-raster ninebit-json
    STATIC_LIBS -lembree3 -lmeshoptimizer -l${CMAKE_DL_LIBS}
    STATIC_REQUIRES OpenImageIO OpenEXR zlib libpng assimp draco fmt ${tbb} libhwy libcrypto)
endif()

# --- The program. Its manual and completions come from the program itself, so that they cannot differ from it.
if(NINEBIT_BUILD_PROGRAM)
  ninebit_installable(ninebit COMPONENT program)
  ninebit_installable(ninebit_pictures COMPONENT program)
  install(TARGETS ninebit DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(TARGETS ninebit_pictures DESTINATION lib/ninebit COMPONENT program)  # where the program looks for it
  set(generated)
  function(ninebit_generated form file destination)
    add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/${file} DEPENDS ninebit VERBATIM
                       COMMAND $<TARGET_FILE:ninebit> generate ${form} > ${PROJECT_BINARY_DIR}/${file})
    set(generated ${generated} ${PROJECT_BINARY_DIR}/${file} PARENT_SCOPE)
    install(FILES ${PROJECT_BINARY_DIR}/${file} DESTINATION ${destination} COMPONENT program ${ARGN})
  endfunction()
  ninebit_generated(man ninebit.1 ${CMAKE_INSTALL_MANDIR}/man1)
  ninebit_generated(bash ninebit.bash ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ninebit)
  ninebit_generated(zsh _ninebit ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  ninebit_generated(fish ninebit.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  add_custom_target(ninebit_generated ALL DEPENDS ${generated})
  foreach(file IN LISTS generated)
    ninebit_installable(ninebit_generated FILE ${file} COMPONENT program)
  endforeach()
endif()
# --- The Python package.
if(NINEBIT_BUILD_PYTHON)
  set(NINEBIT_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING "Folder of Python's packages, below the prefix or absolute")
  foreach(module IN ITEMS ninebit_python_combiner ninebit_python_verbs ninebit_pictures)
    ninebit_installable(${module} COMPONENT python)
    install(TARGETS ${module} DESTINATION ${NINEBIT_PYTHON_INSTALL_DIR}/ninebit COMPONENT python)
  endforeach()
  install(DIRECTORY ${PROJECT_BINARY_DIR}/python/ninebit DESTINATION ${NINEBIT_PYTHON_INSTALL_DIR} COMPONENT python
          FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  # Compiled now: users may not write there, and would compile it at every import. A Debian package compiles when it is
  # installed.
  install(CODE "
    if(NOT \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" MATCHES \"/_CPack_Packages/\")
      get_filename_component(folder \"${NINEBIT_PYTHON_INSTALL_DIR}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
      execute_process(COMMAND ${Python_EXECUTABLE} -m compileall -q -s \"\$ENV{DESTDIR}\" -p / \"\$ENV{DESTDIR}\${folder}/ninebit\")
      file(GLOB compiled RELATIVE \"\$ENV{DESTDIR}/\" \"\$ENV{DESTDIR}\${folder}/ninebit/__pycache__/*.pyc\")
      list(TRANSFORM compiled PREPEND /)
      list(APPEND CMAKE_INSTALL_MANIFEST_FILES \${compiled})
    endif()
  " COMPONENT python)
endif()
# Debian packages have a copyright file of their own instead.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT notes)

if(NINEBIT_IS_MAIN)
  add_custom_target(uninstall VERBATIM
                    COMMAND ${CMAKE_COMMAND} -DNINEBIT_BUILD=${PROJECT_BINARY_DIR}
                            -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake)
  include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
endif()
