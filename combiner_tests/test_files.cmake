# The tests of a room, as CTest reads it: `room`, its `part`, its `program` (after an emulator, if it needs one) and
# `sources`, the `folder` and the `environment` that it runs in. A file is one test, as starting a process takes longer than most cases. Its
# cases are those that its lines have.
cmake_policy(VERSION 3.22)
set(known)
set(tests ${room}.others)
list(REMOVE_ITEM program "")
foreach(source IN LISTS sources)
  file(STRINGS ${source} cases REGEX "^TEST(_[FP])?\\([A-Za-z0-9_]+, [A-Za-z0-9_]+\\)")
  if(cases)
    list(TRANSFORM cases REPLACE "^TEST_P\\(([^,]+), ([^)]+)\\).*" "*\\1.\\2/*")
    list(TRANSFORM cases REPLACE "^TEST(_F)?\\(([^,]+), ([^)]+)\\).*" "\\2.\\3")
    list(JOIN cases ":" filter)
    list(APPEND known ${filter})
    get_filename_component(name ${source} NAME_WE)
    string(REGEX REPLACE "_test$" "" name ${room}.${name})
    add_test(${name} ${program} --gtest_filter=${filter})
    list(APPEND tests ${name})
  endif()
endforeach()
# Cases that stand in the sources in another way: none, as it should be; but nothing is left out.
list(JOIN known ":" known)
add_test(${room}.others ${program} --gtest_filter=-${known})
# A filter that chooses no case, as of a file that is not compiled in, is a failure of the file's test.
list(REMOVE_ITEM tests ${room}.others)
if(tests)
  set_tests_properties(${tests} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests from 0 test suites")
endif()
set_tests_properties(${tests} ${room}.others PROPERTIES LABELS "${room};part_${part}" TIMEOUT 1800 WORKING_DIRECTORY ${folder}
                     ENVIRONMENT "${environment}")
