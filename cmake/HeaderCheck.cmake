# SPDX-License-Identifier: Apache-2.0
# Target header_check: every header that no source file of the same name includes first (tools/lint
# holds those to it) is compiled: alone by the dev preset, so that each header names all it needs, and
# several as one by the release preset, which takes less time and finds less.
file(GLOB_RECURSE headers RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS
     ${CMAKE_SOURCE_DIR}/src/*.h ${CMAKE_SOURCE_DIR}/include/oriel/*.h)
set(units)
foreach(header ${headers})
  string(REGEX REPLACE "\\.h$" ".cpp" source ${CMAKE_SOURCE_DIR}/${header})
  if(NOT EXISTS ${source})
    string(REGEX REPLACE "^(src|include)/" "" included ${header})
    string(REGEX REPLACE "[/.]" "_" unit ${included})
    set(path ${CMAKE_BINARY_DIR}/header_check/${unit}.cpp)
    file(CONFIGURE OUTPUT ${path} CONTENT "#include \"${included}\"\n#include \"${included}\"\n")
    list(APPEND units ${path})
  endif()
endforeach()
add_library(header_check OBJECT EXCLUDE_FROM_ALL ${units})
target_link_libraries(header_check PRIVATE oriel_prepare oriel_output oriel_analysis)
