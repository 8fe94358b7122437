# SPDX-License-Identifier: Apache-2.0
# Run by cpack between installing and packing: changes forms and places of files to those of
# Debian.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr)
set(doc ${usr}/share/doc/oriel)

# `copyright` names the licence; its text is on every Debian system.
file(REMOVE ${doc}/LICENSE)
file(WRITE ${doc}/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Oriel

Files: *
Copyright: The Oriel authors
License: Apache-2.0

License: Apache-2.0
 Licensed under the Apache License, Version 2.0. On Debian systems the text of
 the licence is in /usr/share/common-licenses/Apache-2.0.
")

# Manual page and changelog are compressed by gzip.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${doc}/changelog
"oriel (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Oriel ${CPACK_PACKAGE_VERSION}; changes: /usr/share/doc/oriel/CHANGELOG.md

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
foreach(page ${doc}/changelog ${usr}/share/man/man1/oriel.1)
  if(EXISTS ${page})
    execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()

# Debian's zsh reads completions of packages from vendor-completions.
if(EXISTS ${usr}/share/zsh/site-functions)
  file(RENAME ${usr}/share/zsh/site-functions ${usr}/share/zsh/vendor-completions)
endif()
