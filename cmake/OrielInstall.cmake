# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where: the program, the module of image files where the program looks
# for it (src/image/module.h), the declarations of the built-in shaders as .mi files, the ready
# materials with their textures (apps/oriel/templates.h says where they are looked for), pages for
# people. All of it may be moved: the program finds its files from where it stands itself.
include(GNUInstallDirs)

# The archive of tools/package has copies of all shared libraries in lib/oriel/libraries. RPATH in
# place of RUNPATH: it also holds for what the libraries and the module need in turn, and comes before
# LD_LIBRARY_PATH, which other programs set for their own libraries.
set_target_properties(oriel PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/oriel/libraries")
target_link_options(oriel PRIVATE LINKER:--disable-new-dtags)
install(TARGETS oriel RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# "lib" by name: the program looks in ../lib/oriel, whatever the system calls its library folder.
install(TARGETS oriel_image_files LIBRARY DESTINATION lib/oriel)
if(TARGET oriel_mpi)
  install(TARGETS oriel_mpi LIBRARY DESTINATION lib/oriel)
endif()

# The program writes the declarations from the shaders' own tables. A run that fails leaves no file
# behind that would pass for one.
set(declarations)
foreach(library base architectural physics oriel)
  set(file ${CMAKE_BINARY_DIR}/mi/${library}.mi)
  add_custom_command(
    OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/mi
    COMMAND oriel shaders --mi ${library} > ${file}.new
    COMMAND ${CMAKE_COMMAND} -E rename ${file}.new ${file}
    DEPENDS oriel
    COMMENT "Writing the declarations ${library}.mi"
    VERBATIM)
  list(APPEND declarations ${file})
endforeach()
add_custom_target(oriel_declarations ALL DEPENDS ${declarations})
install(FILES ${declarations} DESTINATION ${CMAKE_INSTALL_DATADIR}/oriel/mi)

# "share" by name, as the program looks there.
install(FILES ${CMAKE_SOURCE_DIR}/data/templates.mi DESTINATION share/oriel)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/data/textures DESTINATION share/oriel
        FILES_MATCHING PATTERN "*.exr" PATTERN "__pycache__" EXCLUDE)

# The page of `oriel studio`, where the program looks for it.
if(EXISTS ${CMAKE_SOURCE_DIR}/integrations/studio/index.html)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/integrations/studio DESTINATION share/oriel
          FILES_MATCHING REGEX "\\.(html|js|css|svg|png)$" PATTERN "node_modules" EXCLUDE)
endif()

# The extension of Blender, to be installed there from this file.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  file(GLOB extension CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/integrations/blender/oriel_blender/*)
  add_custom_command(
    OUTPUT ${CMAKE_BINARY_DIR}/oriel-blender.zip
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/blender-extension
            ${CMAKE_BINARY_DIR}/oriel-blender.zip
    DEPENDS ${extension} ${CMAKE_SOURCE_DIR}/tools/blender-extension
    COMMENT "Packing oriel-blender.zip"
    VERBATIM)
  add_custom_target(oriel_blender ALL DEPENDS ${CMAKE_BINARY_DIR}/oriel-blender.zip)
  install(FILES ${CMAKE_BINARY_DIR}/oriel-blender.zip DESTINATION share/oriel/blender)
endif()

# For those who write shaders: headers, and how CMake and pkg-config find them. Their places below
# the prefix are by name, as the program and the package look there. `cmake --install BUILD
# --component shaders` puts only these.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/oriel/sdk DESTINATION include/oriel
        COMPONENT shaders)
configure_file(${CMAKE_CURRENT_LIST_DIR}/shaders/OrielShadersConfigVersion.cmake.in
               ${CMAKE_BINARY_DIR}/shaders/OrielShadersConfigVersion.cmake @ONLY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/shaders/OrielShadersFlags.cmake.in
               ${CMAKE_BINARY_DIR}/shaders/OrielShadersFlags.cmake @ONLY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/shaders/oriel-shaders.pc.in
               ${CMAKE_BINARY_DIR}/shaders/oriel-shaders.pc @ONLY)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/shaders/OrielShadersConfig.cmake
              ${CMAKE_BINARY_DIR}/shaders/OrielShadersConfigVersion.cmake
              ${CMAKE_BINARY_DIR}/shaders/OrielShadersFlags.cmake
        DESTINATION lib/cmake/OrielShaders COMPONENT shaders)
install(FILES ${CMAKE_BINARY_DIR}/shaders/oriel-shaders.pc DESTINATION lib/pkgconfig
        COMPONENT shaders)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/shaders DESTINATION share/oriel/examples
        COMPONENT shaders)

# For programs that embed it: the C interface and its library.
set_target_properties(oriel_embed PROPERTIES INSTALL_RPATH "$ORIGIN/oriel/libraries")
install(TARGETS oriel_embed LIBRARY DESTINATION lib COMPONENT embedding)
install(FILES ${CMAKE_SOURCE_DIR}/include/oriel/oriel.h DESTINATION include/oriel
        COMPONENT embedding)
install(FILES ${CMAKE_SOURCE_DIR}/examples/embed/relight.c DESTINATION share/oriel/examples/embed
        COMPONENT embedding)

# For those who use it: the pages, and what shells and `man` read.
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/README.md
              ${CMAKE_SOURCE_DIR}/CHANGELOG.md
        DESTINATION share/doc/oriel)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION share/doc/oriel/docs
        FILES_MATCHING PATTERN "*.md" PATTERN "*.html" PATTERN "*.png" PATTERN "*.jpg"
        PATTERN "*.svg" PATTERN "dev" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/scenes/nine-tiles/nine-tiles.mi
              ${CMAKE_SOURCE_DIR}/scenes/guide/room.mi
        DESTINATION share/oriel/examples/scenes)
function(oriel_install_page file folder)
  if(EXISTS ${CMAKE_SOURCE_DIR}/packaging/${file})
    install(FILES ${CMAKE_SOURCE_DIR}/packaging/${file} DESTINATION ${folder} ${ARGN})
  endif()
endfunction()
oriel_install_page(oriel.1 share/man/man1)
oriel_install_page(completion/oriel.bash share/bash-completion/completions RENAME oriel)
oriel_install_page(completion/_oriel share/zsh/site-functions)
oriel_install_page(completion/oriel.fish share/fish/vendor_completions.d)
include(OrielPackage)
