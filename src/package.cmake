# What belongs to the program besides itself, in the places where systems look for it, and packages:
# `cpack --config build/release/CPackConfig.cmake` makes a .deb of each component (program, library,
# and python where the module is built) and a .tar.gz. The program itself writes its manual pages
# and completions when it is installed.
set(words ${PROJECT_BINARY_DIR}/words)
find_program(STIPPLE_GZIP gzip REQUIRED)
install(CODE "
  set(words ${words})
  file(REMOVE_RECURSE \${words})
  file(MAKE_DIRECTORY \${words}/man1 \${words}/man7)
  function(run)
    execute_process(COMMAND \${ARGN} COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  if(EXISTS $<TARGET_FILE:stipple>)  # the library can be installed alone
    run($<TARGET_FILE:stipple> help --man -o \${words})
    file(GLOB pages \${words}/*.1 \${words}/*.7)
    run(${STIPPLE_GZIP} -9n \${pages})
    run($<TARGET_FILE:stipple> completions bash OUTPUT_FILE \${words}/stipple)
    run($<TARGET_FILE:stipple> completions zsh OUTPUT_FILE \${words}/_stipple)
    run($<TARGET_FILE:stipple> completions fish OUTPUT_FILE \${words}/stipple.fish)
  endif()
  foreach(section 1 7)
    file(GLOB pages \${words}/*.\${section}.gz)
    file(COPY \${pages} DESTINATION \${words}/man\${section})
  endforeach()
  run(${STIPPLE_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE \${words}/changelog.gz)
  run(${STIPPLE_GZIP} -9nc ${PROJECT_BINARY_DIR}/changelog.Debian
      OUTPUT_FILE \${words}/changelog.Debian.gz)
" ALL_COMPONENTS)
install(DIRECTORY ${words}/man1 ${words}/man7 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${words}/stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
foreach(folder site-functions vendor-completions)  # the second is Debian's
  install(FILES ${words}/_stipple DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
endforeach()
install(FILES ${words}/stipple.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
if(STIPPLE_FFT STREQUAL fftw)
  set(fft_licence
"Binaries are linked with FFTW, which is under the GNU General Public License, version 2 or later: as a
whole, a binary is under that licence, which Debian systems have in /usr/share/common-licenses/GPL-2.")
else()
  file(READ ${POCKETFFT_HEADER} fft_licence LIMIT 4000)
  string(REGEX REPLACE "^[^*]*[*]+\n|[*]/.*" "" fft_licence "${fft_licence}")
  string(PREPEND fft_licence "So is this binary, which has code of pocketfft in it:\n\n")
endif()
if(archives)
  string(APPEND fft_licence "\n
The program has libpng and zlib in it. Their licences are in /usr/share/doc/libpng-dev/copyright and
/usr/share/doc/zlib1g-dev/copyright of Debian systems.")
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright @ONLY CONTENT
"stipple ${PROJECT_VERSION}

The sources are under this licence:

@licence@
@fft_licence@
")
install(FILES ${PROJECT_BINARY_DIR}/copyright ${words}/changelog.gz ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

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
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-scipy, stipple")
endif()
set(about "Sample points for integration, rendering, simulation and experiments: random
numbers, low-discrepancy sequences, nets, lattices and blue noise; maps of them
onto other domains and densities; discrepancies, spectra, tests and distances
that measure how even they are.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${about} This is the program, for pipes.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${about} This is the C++ library.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${about} This is the Python module.")
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/[.]git(/|$)" "/build/")
include(CPack)
