# SPDX-License-Identifier: Apache-2.0
# Tests that need compilers rather than a test program: the headers for shaders in each standard, and
# the package that shader writers find with CMake. Clang's are skipped where it is not installed.
set(sdk ${CMAKE_SOURCE_DIR}/include/oriel/sdk)
foreach(pair gcc:c99 gcc:c17 g++:c++98 g++:c++11 g++:c++17 g++:c++20
             clang:c99 clang:c17 clang++:c++98 clang++:c++11 clang++:c++17 clang++:c++20)
  string(REPLACE ":" ";" parts ${pair})
  list(GET parts 0 compiler)
  list(GET parts 1 standard)
  # That a header names all it needs shows in the oldest standard of each language.
  set(which top)
  if(standard MATCHES "99|98")
    set(which all)
  endif()
  add_test(NAME sdk.headers.${compiler}.${standard}
           COMMAND ${CMAKE_COMMAND} -DCOMPILER=${compiler} -DSTANDARD=${standard} -DFOLDER=${sdk}
                   -DWHICH=${which} -DTRAPS=${CMAKE_SOURCE_DIR}/tests/sdk/traps
                   -DWORK=${CMAKE_BINARY_DIR}/sdk_headers/${compiler}-${standard}
                   -P ${CMAKE_SOURCE_DIR}/tests/sdk/compile_headers.cmake)
  set_tests_properties(sdk.headers.${compiler}.${standard} PROPERTIES SKIP_REGULAR_EXPRESSION
                                                                      "SKIPPED:")
endforeach()

add_test(NAME sdk.package
         COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR} -DWORK=${CMAKE_BINARY_DIR}/sdk_package
                 -P ${CMAKE_SOURCE_DIR}/tests/sdk/use_package.cmake)
