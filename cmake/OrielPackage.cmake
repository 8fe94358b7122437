# SPDX-License-Identifier: Apache-2.0
# What `cpack -G DEB` makes of an installation: one package for Debian 12. tools/package builds it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME oriel)
set(CPACK_PACKAGE_VENDOR "The Oriel project")
# No address yet: RFC 2606 keeps .invalid free.
set(CPACK_PACKAGE_CONTACT "The Oriel maintainers <maintainers@oriel.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "physically based renderer for mental ray scenes")
set(CPACK_PACKAGE_DESCRIPTION
"Oriel renders mental ray .mi scenes with the complete architectural shader
library, by path tracing, final gathering and photons. It measures light in lux
and cd/m2, imports glTF, OBJ, FBX, Collada and IFC models, and loads shaders in
C and C++ that were written for mental ray.
.
This package has the program, its manual, and the headers for shader writers.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_MONOLITHIC_INSTALL ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# Depends: by dpkg-shlibdeps, of the program and of the module it opens.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake")
# Folders and files have the rights that Debian asks for, whatever those of the checkout are.
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# What Debian has in other places or forms than an installation has it.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/packaging/debian.cmake)
include(CPack)

if(ORIEL_TESTS)
  add_test(NAME packaging.Installed COMMAND ${CMAKE_SOURCE_DIR}/packaging/test-install
           ${CMAKE_BINARY_DIR})
  add_test(NAME packaging.Debian COMMAND ${CMAKE_SOURCE_DIR}/packaging/test-debian
           ${CMAKE_BINARY_DIR})
  add_test(NAME packaging.Archive COMMAND ${CMAKE_SOURCE_DIR}/packaging/test-archive
           ${CMAKE_BINARY_DIR})
  set_tests_properties(packaging.Installed packaging.Debian packaging.Archive PROPERTIES
                       SKIP_RETURN_CODE 77 TIMEOUT 300 RESOURCE_LOCK install_manifest COST 100)
endif()
