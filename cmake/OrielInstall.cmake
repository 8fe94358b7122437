# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where: the program, the module of image files where the program looks
# for it (src/image/module.h), and the declarations of the built-in shaders as .mi files.
include(GNUInstallDirs)

install(TARGETS oriel RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# "lib" by name: the program looks in ../lib, whatever the system calls its own library folder.
install(TARGETS oriel_image_files LIBRARY DESTINATION lib)

# The program writes the declarations from the shaders' own tables. A run that fails leaves no file
# behind that would pass for one.
set(declarations)
foreach(library base architectural physics)
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
