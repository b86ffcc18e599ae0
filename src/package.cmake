# What belongs to the program besides itself, in the places where systems look for it, and packages:
# `cpack --config build/release/CPackConfig.cmake` makes a .deb and a .tar.gz. The program itself
# writes its manual pages and completions when it is installed.
set(words ${PROJECT_BINARY_DIR}/words)
find_program(STIPPLE_GZIP gzip REQUIRED)
install(CODE "
  set(words ${words})
  file(REMOVE_RECURSE \${words})
  file(MAKE_DIRECTORY \${words}/man1 \${words}/man7)
  function(run)
    execute_process(COMMAND \${ARGN} COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  run($<TARGET_FILE:stipple> help --man -o \${words})
  file(GLOB pages \${words}/*.1 \${words}/*.7)
  run(${STIPPLE_GZIP} -9n \${pages})
  foreach(section 1 7)
    file(GLOB pages \${words}/*.\${section}.gz)
    file(COPY \${pages} DESTINATION \${words}/man\${section})
  endforeach()
  run($<TARGET_FILE:stipple> completions bash OUTPUT_FILE \${words}/stipple)
  run($<TARGET_FILE:stipple> completions zsh OUTPUT_FILE \${words}/_stipple)
  run($<TARGET_FILE:stipple> completions fish OUTPUT_FILE \${words}/stipple.fish)
  run(${STIPPLE_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE \${words}/changelog.gz)
")
install(DIRECTORY ${words}/man1 ${words}/man7 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${words}/stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
foreach(folder site-functions vendor-completions)  # the second is Debian's
  install(FILES ${words}/_stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
endforeach()
install(FILES ${words}/stipple.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright @ONLY CONTENT
"stipple ${PROJECT_VERSION}

The sources are under this licence:

@licence@
The program is linked with FFTW, which is under the GNU General Public License, version 2 or later: as
a whole, this binary is under that licence, which Debian systems have in
/usr/share/common-licenses/GPL-2.
")
install(FILES ${PROJECT_BINARY_DIR}/copyright ${words}/changelog.gz ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME stipple)
set(CPACK_PACKAGE_VENDOR stipple)
set(CPACK_PACKAGE_CONTACT "The stipple authors <stipple@localhost>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For programs that are built with the library.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libfmt-dev, nlohmann-json3-dev, libtbb-dev, libpng-dev, zlib1g-dev, libzstd-dev, libfftw3-dev, libmuparser-dev, pkg-config")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Points for whatever samples a domain: random numbers, low-discrepancy
sequences, nets, lattices and blue noise; maps of them onto other domains and
densities; discrepancies, spectra, tests and distances that tell how even they
are. A program for pipes, and the C++ library behind it.")
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/[.]git(/|$)" "/build/")
include(CPack)
