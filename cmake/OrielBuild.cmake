# SPDX-License-Identifier: Apache-2.0
# How every folder of Oriel is built: one static library of its *.cpp, one test program of its
# *_test.cpp. Folders name only the folders below them (see docs/dev/architecture.md).

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# Files of a folder are compiled as one, up to forty, since most of a file's time goes into the
# headers it includes: twenty take six tenths of the time of two times ten. Names in unnamed namespaces are therefore unique in their
# folder. The dev preset compiles each file alone, so that a change recompiles little.
option(CMAKE_UNITY_BUILD "Compile several files of a folder as one" ON)
set(CMAKE_UNITY_BUILD_BATCH_SIZE 40 CACHE STRING "Files that are compiled as one")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_compile_options(-Wall -Wextra -Wshadow -Wno-missing-field-initializers
                    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Werror
                    -fno-math-errno -fno-trapping-math)
if(CMAKE_UNITY_BUILD)
  add_compile_options(-Wno-shadow)  # names of one file beside those of another
endif()
# Nobody replaces our functions when the program is loaded, so they may be inlined although the code
# is position independent; and registers that vectors of three floats are pieced together in wait for
# the pieces. Together a path takes 3 to 9 % fewer instructions.
add_compile_options(-fno-semantic-interposition -fno-tree-slp-vectorize)
# The same bytes on every processor (docs/dev/adr/0004): left to itself the compiler fuses a product
# and a sum where that suits the processor. Where fusing pays, the code calls fma by name.
if(ORIEL_ARCH STREQUAL "native")
  add_compile_definitions(ORIEL_NATIVE=1)
else()
  add_compile_options(-ffp-contract=off)
endif()
if(ORIEL_ARCH)
  add_compile_options(-march=${ORIEL_ARCH})
endif()
if(ORIEL_ASSERTIONS)
  add_compile_definitions(ORIEL_ASSERTIONS=1)
endif()
if(ORIEL_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(ORIEL_SANITIZE_THREADS)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
endif()
if(ORIEL_FUZZ)  # GCC is the compiler that warnings are cleaned for
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer -Wno-error)
  add_link_options(-fsanitize=address,undefined)
endif()

# oriel_folder(NAME DEPS lower folders... LIBS third-party targets...)
function(oriel_folder name)
  cmake_parse_arguments(ARG "" "" "DEPS;LIBS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ARG_DEPS PREPEND oriel_)
  if(sources)
    add_library(oriel_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(oriel_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(oriel_${name} ${scope} ${CMAKE_SOURCE_DIR}/src
                                                    ${CMAKE_SOURCE_DIR}/include)
  target_link_libraries(oriel_${name} ${scope} ${ARG_DEPS} ${ARG_LIBS})
  if(ORIEL_TESTS AND tests)
    oriel_test(${name}_test SOURCES ${tests} DEPS ${name})
  endif()
endfunction()

# A program whose users' shared libraries call the C interface of src/sdk: all of it is linked in
# and its functions are visible to them.
function(oriel_hosts_shaders target)
  target_link_libraries(${target} PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,oriel_sdk>)
  foreach(names mi_* mayabase_* oriel_approx_* oriel_is_* oriel_light_* oriel_spectrum_*
          oriel_options_* oriel_framebuffers_* oriel_parameter_*
          exit _exit _Exit quick_exit)
    target_link_options(${target} PRIVATE "LINKER:--export-dynamic-symbol=${names}")
  endforeach()
endfunction()

# How shaders of users are compiled, by `oriel shader-build`, by oriel_add_shader_library of the
# installed package and by pkg-config: old sources compare overflowing integers, cast between
# pointers to different types, and test `this` and dereferenced pointers against null.
set(ORIEL_SHADER_FLAGS -fno-strict-aliasing -fwrapv -fno-delete-null-pointer-checks)
# Makes a C++ function that ends without `return` go back to its caller, as it does in C.
set(ORIEL_SHADER_RETURN_FLAGS_CLANG -fno-strict-return)
set(ORIEL_SHADER_RETURN_FLAGS_GNU -fsanitize=unreachable -fsanitize-undefined-trap-on-error)
list(JOIN ORIEL_SHADER_FLAGS " " ORIEL_SHADER_FLAGS_TEXT)
list(JOIN ORIEL_SHADER_RETURN_FLAGS_GNU " " ORIEL_SHADER_RETURN_FLAGS_GNU_TEXT)

# The `main` of all test programs. Its headers are its own: a program that tests headers alone gets
# nothing of Oriel with it.
if(ORIEL_TESTS)
  add_library(oriel_test_main STATIC ${CMAKE_SOURCE_DIR}/tests/main.cpp)
  target_include_directories(oriel_test_main PRIVATE ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(oriel_test_main PUBLIC GTest::gtest)

  # What tests share (tests/support). Its headers say what they need: unit tests of a folder include
  # those that use nothing above that folder, and the linker takes no more than is used.
  file(GLOB support CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/support/*.cpp)
  add_library(oriel_test_support STATIC ${support})
  target_include_directories(oriel_test_support PUBLIC ${CMAKE_SOURCE_DIR}/tests
                             PRIVATE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/include)
  target_link_libraries(oriel_test_support PRIVATE GTest::gtest Imath::Imath fmt::fmt TBB::tbb)
  target_compile_options(oriel_test_support PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(oriel_test_support PRIVATE ORIEL_PROGRAM="$<TARGET_FILE:oriel>")
endif()

# oriel_test(NAME SOURCES files... DEPS folders...): a GoogleTest program known to ctest.
function(oriel_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;LIBS" ${ARGN})
  list(TRANSFORM ARG_DEPS PREPEND oriel_)
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE oriel_test_support ${ARG_DEPS} ${ARG_LIBS} oriel_test_main)
  # Half the time to compile; what the tests call is optimised fully.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1> -Wno-maybe-uninitialized)
  target_compile_definitions(${name} PRIVATE ORIEL_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
