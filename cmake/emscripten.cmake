# The part of ninebit that runs in a browser, compiled by Emscripten: combiners, languages, rasterizer, techniques, effects.
# Libraries that are headers alone are those of the machine; their folder is linked, because Emscripten must not see the
# machine's other headers.
set(NINEBIT_THREADS OFF)
set(NINEBIT_SHARED OFF)
set(NINEBIT_INSTALL OFF)
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(name IN ITEMS hwy fmt nlohmann glm meshoptimizer.h)
  find_path(NINEBIT_${name}_PARENT ${name} PATHS /usr/include /usr/local/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH
            REQUIRED)
  file(CREATE_LINK ${NINEBIT_${name}_PARENT}/${name} ${headers}/${name} SYMBOLIC)
endforeach()
set(GLM_INCLUDE_DIR ${headers})
foreach(target IN ITEMS PkgConfig::HWY fmt::fmt nlohmann_json::nlohmann_json meshoptimizer::meshoptimizer)
  add_library(${target} INTERFACE IMPORTED)
  set_target_properties(${target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${headers}
                                             INTERFACE_INCLUDE_DIRECTORIES ${headers})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
# Its vectors, and what its C++ library lacks.
target_compile_options(ninebit_options INTERFACE -msimd128
                       "SHELL:-include ${PROJECT_SOURCE_DIR}/src/system/emscripten/libcxx_gaps.h")
