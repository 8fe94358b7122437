# SPDX-License-Identifier: Apache-2.0
# Installs what shader writers get, and builds a library with it in a project of its own.
#   cmake -DBUILD=... -DWORK=... -P this file
cmake_minimum_required(VERSION 3.25)
function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}:\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${BUILD} --component shaders --prefix ${WORK}/installed)
file(WRITE ${WORK}/project/CMakeLists.txt "cmake_minimum_required(VERSION 3.16)
project(mine LANGUAGES C CXX)
find_package(OrielShaders REQUIRED)
oriel_add_shader_library(mine plain.c lit.cpp)
")
file(WRITE ${WORK}/project/plain.c "#include <shader.h>
DLLEXPORT int plain_version(void) { return 1; }
")
file(WRITE ${WORK}/project/lit.cpp "#include <geoshader.h>
#include <mia_material_api.h>
#include <shader.h>
extern \"C\" DLLEXPORT int lit_version(void) { return 1; }
")
must(${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/installed)
must(${CMAKE_COMMAND} --build ${WORK}/build --verbose)
# As `oriel shader-build` compiles: old sources rely on it.
set(safe_flags -fno-strict-aliasing -fwrapv -fno-delete-null-pointer-checks)
function(expect_safe_flags text)
  foreach(flag ${safe_flags} ${ARGN})
    if(NOT text MATCHES " ${flag} ")
      message(FATAL_ERROR "${flag} is missing in:\n${text}")
    endif()
  endforeach()
endfunction()
string(REGEX MATCH "[^\n]* -c [^\n]*plain.c" of_c "${out}")
string(REGEX MATCH "[^\n]* -c [^\n]*lit.cpp" of_cpp "${out}")
expect_safe_flags("${of_c} ")
expect_safe_flags("${of_cpp} " "(-fno-strict-return|-fsanitize=unreachable)")
if(NOT EXISTS ${WORK}/build/mine.so)
  message(FATAL_ERROR "there is no mine.so")
endif()

find_program(pkg_config pkg-config)
if(pkg_config)
  set(ENV{PKG_CONFIG_PATH} ${WORK}/installed/lib/pkgconfig)
  must(${pkg_config} --cflags oriel-shaders)
  string(STRIP "${out}" out)
  expect_safe_flags("${out} ")
  string(REGEX REPLACE "^-I([^ ]*) .*" "\\1" folder "${out}")
  if(NOT EXISTS ${folder}/shader.h)
    message(FATAL_ERROR "pkg-config says '${out}'")
  endif()
endif()
