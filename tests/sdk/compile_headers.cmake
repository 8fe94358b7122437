# SPDX-License-Identifier: Apache-2.0
# Compiles each header for shaders alone, twice, in one standard, without a warning; with -DWHICH=top
# only those that shaders name. Sources of TRAPS follow, as old sources are compiled.
#   cmake -DCOMPILER=gcc -DSTANDARD=c99 -DFOLDER=.../include/oriel/sdk -DTRAPS=... -DWORK=...
#         -P this file
cmake_minimum_required(VERSION 3.25)
find_program(program NAMES ${COMPILER} NO_CACHE)
if(NOT program)
  message("SKIPPED: there is no ${COMPILER} here")
  return()
endif()
string(REGEX MATCH "^c\\+\\+" is_cpp ${STANDARD})
set(extension "c")
if(is_cpp)
  set(extension "cpp")
endif()

file(MAKE_DIRECTORY ${WORK})
file(GLOB headers RELATIVE ${FOLDER} ${FOLDER}/*.h)
if(NOT WHICH STREQUAL "top")
  file(GLOB parts RELATIVE ${FOLDER} ${FOLDER}/shader/*.h ${FOLDER}/geoshader/*.h)
  list(APPEND headers ${parts})
endif()
set(units)
foreach(header ${headers})
  string(REPLACE "/" "_" unit ${header})
  file(WRITE ${WORK}/${unit}.${extension} "#include <${header}>\n#include <${header}>\n")
  list(APPEND units ${WORK}/${unit}.${extension})
endforeach()
execute_process(
  COMMAND ${program} -std=${STANDARD} -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only
          -I${FOLDER} ${units}
  RESULT_VARIABLE result ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${COMPILER} -std=${STANDARD}:\n${messages}")
endif()
set(language c)
if(is_cpp)
  set(language c++)
endif()
execute_process(
  COMMAND ${program} -std=${STANDARD} -w -fsyntax-only -I${FOLDER} -x ${language}
          ${TRAPS}/own_names.c
  RESULT_VARIABLE result ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${COMPILER} -std=${STANDARD}:\n${messages}")
endif()
if(is_cpp)
  string(REPLACE "c++" "gnu++" dialect ${STANDARD})
  execute_process(
    COMMAND ${program} -std=${dialect} -fpermissive -w -fsyntax-only -I${FOLDER}
            ${TRAPS}/old_style.cpp
    RESULT_VARIABLE result ERROR_VARIABLE messages)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${COMPILER} -std=${dialect}:\n${messages}")
  endif()
endif()
