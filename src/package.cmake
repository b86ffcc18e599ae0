# What belongs to the program besides itself, in the places where systems look for it, and packages:
# `cpack --config build/release/CPackConfig.cmake` makes a .deb of each component (program, library,
# and python where the module is built) and a .tar.gz. The program itself writes its manual pages
# and completions after it is built: an installation, perhaps by root, makes no files in the build folder.
find_program(STIPPLE_GZIP gzip REQUIRED)
set(words ${PROJECT_BINARY_DIR}/words)
file(MAKE_DIRECTORY ${words})
if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
  add_custom_command(TARGET stipple POST_BUILD WORKING_DIRECTORY ${words}
    COMMAND ${CMAKE_COMMAND} -E rm -rf man && ${CMAKE_COMMAND} -E make_directory man
    COMMAND stipple help --man -o man && ${STIPPLE_GZIP} -9n man/*.1 man/*.7
    COMMAND stipple completions bash > stipple
    COMMAND stipple completions zsh > _stipple
    COMMAND stipple completions fish > stipple.fish)
endif()
foreach(section 1 7)
  install(DIRECTORY ${words}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section}
          FILES_MATCHING PATTERN "*.${section}.gz")
endforeach()
install(FILES ${words}/stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
foreach(folder site-functions vendor-completions)  # the second is Debian's
  install(FILES ${words}/_stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
endforeach()
install(FILES ${words}/stipple.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
# Exists before root installs, so that it remains its owner's.
file(TOUCH ${PROJECT_BINARY_DIR}/install_manifest.txt)

# The README without its way to build, and with pages as the program shows them, not as links.
file(READ ${PROJECT_SOURCE_DIR}/README.md readme)
string(REGEX REPLACE "\n## Get it\n.*(\n## A handful)" "\\1" readme "${readme}")
string(REGEX REPLACE "([^!])\\[([^]]*)\\]\\(data/guide/([^)]*)[.]md\\)" "\\1\\2 (`stipple help \\3`)"
  readme "${readme}")
string(REGEX REPLACE "([^!])\\[([^]]*)\\]\\((data/[^)]*)\\)" "\\1\\2 (`\\3` of the sources)" readme "${readme}")
string(REPLACE "see LICENSE" "see copyright" readme "${readme}")
file(WRITE ${words}/README.md "${readme}")

file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^.*authors\n\n" "" licence "${licence}")
string(REGEX REPLACE "\n$" "" licence " ${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
string(REPLACE "\n \n" "\n .\n" licence "${licence}")
set(comment "")
set(pocketfft "")
if(STIPPLE_FFT STREQUAL fftw)
  set(comment " .
 Binaries are linked with FFTW, which is under the GNU General Public License,
 version 2 or later: as a whole, a binary is under that licence, which Debian
 systems have in /usr/share/common-licenses/GPL-2.\n")
else()
  set(pocketfft "Files: pocketfft*
Copyright: 2010-2019 Max-Planck-Society
 2019 Peter Bell
 2003, 2007-2014 Matteo Frigo
 2003, 2007-2014 Massachusetts Institute of Technology
License: BSD-3-clause\n\n")
endif()
if(archives)
  string(APPEND comment " .
 The program has libpng and zlib in it. Their licences are in
 /usr/share/doc/libpng-dev/copyright and /usr/share/doc/zlib1g-dev/copyright of
 Debian systems.\n")
endif()
configure_file(copyright.in ${PROJECT_BINARY_DIR}/copyright @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
install(FILES ${PROJECT_BINARY_DIR}/copyright ${words}/changelog.gz ${words}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/data/overview.png DESTINATION ${CMAKE_INSTALL_DOCDIR}/data)

# Only in packages of Debian: papers for each; examples for the library; the module where Debian's
# Python looks, byte-compiled when it is installed. People without packages use pip.
set(packages "program stipple" "library libstipple-dev")
if(STIPPLE_PYTHON)
  list(APPEND packages "python python3-stipple")
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(CPACK_PACKAGE_CONTACT "The stipple authors <stipple@stipple.invalid>")  # they have no mailbox
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/changelog.Debian @ONLY CONTENT
"stipple (@PROJECT_VERSION@-0local) unstable; urgency=medium

  * Made by CPack; changelog.gz tells what is new.

 -- @CPACK_PACKAGE_CONTACT@  @now@
")
execute_process(COMMAND ${STIPPLE_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
                OUTPUT_FILE ${words}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${STIPPLE_GZIP} -9nc ${PROJECT_BINARY_DIR}/changelog.Debian
                OUTPUT_FILE ${words}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(package IN LISTS packages)
  separate_arguments(package)
  list(POP_FRONT package component)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package})
  install(FILES ${PROJECT_BINARY_DIR}/copyright ${words}/changelog.gz ${words}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/examples
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libstipple-dev
        COMPONENT library EXCLUDE_FROM_ALL PATTERN "*.py" EXCLUDE)
if(STIPPLE_PYTHON)
  set(modules lib/python3/dist-packages/stipple)
  install(TARGETS stipple_module LIBRARY DESTINATION ${modules} COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/python/stipple/ DESTINATION ${modules}
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING REGEX "/(py.typed|[^/]*[.]pyi?)$")
  execute_process(COMMAND ${Python3_EXECUTABLE} -Bc
    "import stipple_build; stipple_build.prepare_metadata_for_build_wheel('${PROJECT_BINARY_DIR}/debian')"
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/python COMMAND_ERROR_IS_FATAL ANY)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/debian/stipple-${PROJECT_VERSION}.dist-info
          DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL)
  foreach(script "postinst py3compile" "prerm py3clean")
    separate_arguments(script)
    list(POP_FRONT script name tool)
    file(WRITE ${PROJECT_BINARY_DIR}/debian/${name}
      "#!/bin/sh\nset -e\nif command -v ${tool} >/dev/null; then ${tool} -p python3-stipple; fi\n")
    list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/${name})
  endforeach()
endif()

set(CPACK_GENERATOR TGZ)
find_program(STIPPLE_SHLIBDEPS dpkg-shlibdeps)
if(STIPPLE_SHLIBDEPS)
  list(PREPEND CPACK_GENERATOR DEB)
endif()
set(CPACK_PACKAGE_NAME stipple)
set(CPACK_PACKAGE_VENDOR stipple)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0local)  # older than any of Debian's own
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# What stippleConfig.cmake finds and a static library is linked with.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libfmt-dev, libpng-dev, libtbb-dev, libzstd-dev, zlib1g-dev, pkgconf")
if(STIPPLE_FFT STREQUAL fftw)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libfftw3-dev")
endif()
if(STIPPLE_MPI)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libopenmpi-dev")
endif()
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "cmake, stipple")
if(STIPPLE_PYTHON)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-scipy, stipple")
endif()
set(about "Sample points for integration, rendering, simulation and experiments: random
numbers, low-discrepancy sequences, nets, lattices and blue noise; maps of them
onto other domains and densities; discrepancies, spectra, tests and distances
that measure how even they are.")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would precede those of the packages
foreach(part "PROGRAM program" "LIBRARY C++ library" "PYTHON Python module")
  string(REGEX MATCH "^([A-Z]+) (.*)$" part "${part}")
  set(CPACK_DEBIAN_${CMAKE_MATCH_1}_DESCRIPTION
      "makes, warps and judges sample sets (${CMAKE_MATCH_2})\n${about}")
endforeach()
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/[.]git(/|$)" "/build/")
include(CPack)
