# Debian packages, one for each component of the installation: `./dev deb`, or `cpack --config build/release/CPackConfig.cmake`.
find_program(NINEBIT_GZIP gzip)
set(NINEBIT_MAINTAINER "The ninebit authors <ninebit@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(NINEBIT_HOMEPAGE "https://ninebit.example.org/" CACHE STRING "Home page of the Debian packages")
mark_as_advanced(NINEBIT_GZIP)
set(debian ${CMAKE_CURRENT_LIST_DIR}/debian)
set(made ${PROJECT_BINARY_DIR}/debian)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ninebit)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT ${NINEBIT_MAINTAINER})
set(CPACK_PACKAGE_HOMEPAGE_URL ${NINEBIT_HOMEPAGE})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # CPack would put it before each package's own
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SOURCE ninebit)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 0)  # all
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${debian}/stage.cmake)
# Where the packages' own shared libraries are found, which depend on each other.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)

set(minor ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # the SONAMEs', too
set(exact "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# ninebit_package(COMPONENT NAME SECTION SYNOPSIS TEXT [DEPENDS ...] [RECOMMENDS ...] [SUGGESTS ...] [CONTROL file ...]
#                 [MULTI_ARCH same|foreign] [ALL] [ARCHITECTURE name])
# `ALL`: of no architecture, and without programs. `ARCHITECTURE`: another one than that of the build; what it needs is then
# not found by CPack. Lines of TEXT have at most 75 characters.
macro(ninebit_package component name section synopsis text)
  cmake_parse_arguments(DEB "ALL" "ARCHITECTURE;MULTI_ARCH" "DEPENDS;RECOMMENDS;SUGGESTS;CONTROL" ${ARGN})
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  if(DEB_MULTI_ARCH)  # for which CPack has no variable before 3.31
    string(APPEND CPACK_DEBIAN_${upper}_PACKAGE_SECTION "\nMulti-Arch: ${DEB_MULTI_ARCH}")
  endif()
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${synopsis}\n${text}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  if(DEB_ALL)
    set(DEB_ARCHITECTURE all)
  endif()
  if(DEB_ARCHITECTURE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_ARCHITECTURE ${DEB_ARCHITECTURE})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS OFF)
  endif()
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${DEB_CONTROL})
  foreach(relation IN ITEMS DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN DEB_${relation} ", " CPACK_DEBIAN_${upper}_PACKAGE_${relation})
  endforeach()
  install(FILES ${debian}/copyright ${made}/changelog.gz ${made}/changelog.Debian.gz
          DESTINATION share/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

configure_file(${debian}/changelog.in ${made}/changelog.Debian @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/docs/CHANGELOG.md ${made}/changelog COPYONLY)
foreach(file IN ITEMS changelog changelog.Debian)
  if(NINEBIT_GZIP)
    execute_process(COMMAND ${NINEBIT_GZIP} -9nf ${made}/${file} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()

set(what "ninebit computes the register combiners of NVIDIA's GeForce 2 bit for bit,
and draws the shadow techniques that were built on them.
.
")
if(NINEBIT_BUILD_PROGRAM)
  ninebit_package(program ninebit graphics "GeForce 2 register combiners and shadow techniques, bit for bit"
    "${what}This program renders scenes; it evaluates, traces, explains, converts and
verifies combiner programs, and measures and proves what they compute."
    MULTI_ARCH foreign RECOMMENDS ninebit-gl SUGGESTS ninebit-doc z3)
  set(layer ninebit-gl graphics "register combiners for OpenGL drivers that have none"
      "${what}This layer adds GL_NV_register_combiners to the OpenGL driver of a
program: `ninebit gl-run` loads it."
      MULTI_ARCH same RECOMMENDS libgl1)
  if(TARGET ninebit_gl)
    ninebit_package(gl ${layer} DEPENDS "ninebit ${exact}")
  endif()
  # The same for programs of 32 bits, beside it. Its only library is C's, as new as the build's.
  if(TARGET ninebit_gl32)
    execute_process(COMMAND getconf GNU_LIBC_VERSION OUTPUT_VARIABLE libc COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "[0-9.]+" libc "${libc}")
    ninebit_package(gl32 ${layer} ARCHITECTURE i386 DEPENDS "ninebit ${exact}" "libc6 (>= ${libc})")
  endif()
endif()
if(NINEBIT_SHARED)
  set(shlibs)
  foreach(library IN LISTS components)
    string(REGEX REPLACE "^libninebit_ninebit$" "libninebit" library libninebit_${library})
    string(APPEND shlibs "${library} ${minor} libninebit${minor} (>= ${PROJECT_VERSION})\n")
  endforeach()
  file(CONFIGURE OUTPUT ${made}/shlibs CONTENT "${shlibs}")
  file(CONFIGURE OUTPUT ${made}/triggers CONTENT "activate-noawait ldconfig\n")
  ninebit_package(libraries libninebit${minor} libs "GeForce 2 register combiners, bit for bit (shared libraries)"
    "${what}These are the libraries for C and C++: combiners, languages, rasterizer,
techniques and studies."
    CONTROL ${made}/shlibs ${made}/triggers)
  # The static libraries' packages, which pkg-config and CMake look for: those of the combiners and the rasterizer; the
  # others are only needed by those who link ninebit::ninebit.
  set(needs libhwy-dev libglm-dev libtbb-dev)
  set(others libfmt-dev libassimp-dev libdraco-dev libmeshoptimizer-dev libembree-dev libopenexr-dev zlib1g-dev libpng-dev
      libopenimageio-dev libssl-dev)
  ninebit_package(development libninebit-dev libdevel "GeForce 2 register combiners, bit for bit (development files)"
    "${what}This package has the headers, the static libraries, and what CMake and
pkg-config read."
    DEPENDS "libninebit${minor} ${exact}" ${needs} RECOMMENDS ${others} SUGGESTS ninebit-doc pkg-config)
endif()
if(NINEBIT_BUILD_PYTHON)
  set(python ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  ninebit_package(python python3-ninebit python "GeForce 2 register combiners, bit for bit (Python 3)"
    "${what}This module runs combiner programs on NumPy arrays, and returns traces,
renderings and studies."
    DEPENDS "python3 (>= ${python})" "python3 (<< ${Python_VERSION_MAJOR}.${next})" python3-numpy
    CONTROL ${debian}/postinst ${debian}/prerm)
endif()

# --- The pages. Doxygen and the playground's bundler are not part of the build, so this package is only made where both
# have run.
install(CODE "
  foreach(part IN ITEMS docs/html/index.html:docs playground/index.html:playground)
    string(REGEX MATCH \"^([^:]+):(.*)\" part \"\${part}\")
    if(NOT EXISTS \"${PROJECT_SOURCE_DIR}/build/\${CMAKE_MATCH_1}\")
      message(FATAL_ERROR \" ninebit-doc needs build/\${CMAKE_MATCH_1}; run first: ./dev \${CMAKE_MATCH_2}\")
    endif()
  endforeach()
" COMPONENT doc EXCLUDE_FROM_ALL)
ninebit_package(doc ninebit-doc doc "GeForce 2 register combiners, bit for bit (documentation)"
  "${what}These are the reference of the C and C++ libraries, the pages with
gallery and tutorials, and the playground: the program in one page for
browsers." ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/docs/html DESTINATION share/doc/ninebit-doc COMPONENT doc EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/build/playground/index.html DESTINATION share/doc/ninebit-doc/playground COMPONENT doc
        EXCLUDE_FROM_ALL)
install(FILES ${debian}/ninebit-doc DESTINATION share/doc-base COMPONENT doc EXCLUDE_FROM_ALL)
include(CPack)
