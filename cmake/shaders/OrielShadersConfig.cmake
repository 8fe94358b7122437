# SPDX-License-Identifier: Apache-2.0
# The package for those who write shaders:
#   find_package(OrielShaders REQUIRED)
#   oriel_add_shader_library(my_shaders marble.c brushed.cpp)      # makes my_shaders.so
# Sources are compiled as `oriel shader-build` does, whatever they rely on of old compilers.
# Target Oriel::shaders brings the headers alone. The functions they declare come from the program that
# loads the library, so nothing is linked.
get_filename_component(_oriel_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(OrielShaders_INCLUDE_DIR "${_oriel_prefix}/include/oriel/sdk")
unset(_oriel_prefix)
if(NOT EXISTS "${OrielShaders_INCLUDE_DIR}/shader.h")
  set(OrielShaders_FOUND FALSE)
  set(OrielShaders_NOT_FOUND_MESSAGE "there is no shader.h in ${OrielShaders_INCLUDE_DIR}")
  return()
endif()

include("${CMAKE_CURRENT_LIST_DIR}/OrielShadersFlags.cmake")

if(NOT TARGET Oriel::shaders)
  add_library(Oriel::shaders INTERFACE IMPORTED)
  set_target_properties(Oriel::shaders PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                  "${OrielShaders_INCLUDE_DIR}")
endif()

# A library as scenes link it: NAME.so, without "lib" in front. Sources in C and C++.
function(oriel_add_shader_library name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE Oriel::shaders)
  target_compile_options(${name} PRIVATE ${OrielShaders_FLAGS})
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    set(returns ${OrielShaders_RETURN_FLAGS_CLANG})
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(returns ${OrielShaders_RETURN_FLAGS_GNU})
  else()
    set(returns -Werror=return-type)
  endif()
  target_compile_options(${name} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:${returns}>")
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX ".so")
endfunction()
