# Rules for `cmake --install` and `cpack`. Components: heft with its data, bench, python, and the libraries
# psychophysics, inference, engine and physics, each of which can be installed without the ones that it
# does not use.
include(CMakePackageConfigHelpers)

install(TARGETS heft_program COMPONENT heft)
install(TARGETS heft_codecs_module heft_window_module LIBRARY
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/heft COMPONENT heft)
install(DIRECTORY protocols DESTINATION ${CMAKE_INSTALL_DATADIR}/heft COMPONENT heft)
# The script that `heft export` adds to its tables.
install(FILES src/record/export/analysis.R
        DESTINATION ${CMAKE_INSTALL_DATADIR}/heft/src/record/export COMPONENT heft)
install(FILES README.md LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT heft)
install(TARGETS heft_bench_program COMPONENT bench)

if(TARGET heft_python_module)  # where Debian's interpreter finds it
  set(heft_python_destination lib/python3/dist-packages/heft)
  install(TARGETS heft_python_module LIBRARY DESTINATION ${heft_python_destination} COMPONENT python)
  install(FILES ${heft_python_files} DESTINATION ${heft_python_destination} COMPONENT python)
endif()

# The program generates its manual page and completion.
foreach(file man/heft.1 bash/heft zsh/_heft fish/heft.fish)
  get_filename_component(format ${file} DIRECTORY)
  list(APPEND heft_generated ${PROJECT_BINARY_DIR}/generated/${file})
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/generated/${file}
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/generated/${format}
                     COMMAND heft_program completion ${format} > ${PROJECT_BINARY_DIR}/generated/${file}
                     DEPENDS heft_program VERBATIM)
endforeach()
add_custom_target(heft_generated ALL DEPENDS ${heft_generated})
install(FILES ${PROJECT_BINARY_DIR}/generated/man/heft.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
        COMPONENT heft)
install(FILES ${PROJECT_BINARY_DIR}/generated/bash/heft
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT heft)
install(FILES ${PROJECT_BINARY_DIR}/generated/zsh/_heft
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT heft)
install(FILES ${PROJECT_BINARY_DIR}/generated/fish/heft.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT heft)

set(heft_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/heft)
# heft_install(component folders...): their libraries and headers.
function(heft_install component)
  foreach(folder ${ARGN})
    if(TARGET heft_${folder})
      install(TARGETS heft_${folder} EXPORT heft-${component} COMPONENT ${component})
      install(DIRECTORY src/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/heft
              COMPONENT ${component} FILES_MATCHING PATTERN "*.h" PATTERN "*.inc")
    endif()
  endforeach()
  list(GET ARGN -1 last)
  if(TARGET heft_${last})
    install(EXPORT heft-${component} NAMESPACE heft:: DESTINATION ${heft_cmake_folder}
            COMPONENT ${component})
  endif()
endfunction()
heft_install(psychophysics base psychophysics)
heft_install(inference inference)
heft_install(engine experiment tasks engine)
heft_install(physics physics)
configure_file(.install/heft-config.cmake ${PROJECT_BINARY_DIR}/heft-config.cmake COPYONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/heft-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/heft-config.cmake
        ${PROJECT_BINARY_DIR}/heft-config-version.cmake DESTINATION ${heft_cmake_folder}
        COMPONENT psychophysics)

# Debian packages: heft, heft-bench, libheft-dev to build C++ programs with, and python3-heft.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Heft's authors <heft@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_HEFT_PACKAGE_NAME heft)
set(CPACK_DEBIAN_HEFT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_HEFT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_HEFT_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_HEFT_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_HEFT_PACKAGE_SUGGESTS heft-bench)

set(CPACK_DEBIAN_BENCH_PACKAGE_NAME heft-bench)
set(CPACK_DEBIAN_BENCH_PACKAGE_SECTION science)
set(CPACK_DEBIAN_BENCH_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BENCH_PACKAGE_DEPENDS "heft (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_BENCH_PACKAGE_RECOMMENDS gnuplot-nox)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libheft-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, libmd-dev")
# Needed by heft::physics and by heft::inference only.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libbullet-dev, libnlopt-dev")

if(TARGET heft_python_module)
  math(EXPR heft_next_python "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-heft)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "heft (= ${PROJECT_VERSION}), python3-pandas, \
python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${heft_next_python})")
endif()

include(CPack)
cpack_add_component(heft GROUP heft)
cpack_add_component_group(heft DESCRIPTION "Psychophysics experiments on perceived mass
Heft runs them in augmented reality, and simulates, replays and analyzes them.")
cpack_add_component(bench GROUP bench)
cpack_add_component_group(bench DESCRIPTION "Heft's studies of speed and accuracy
The program heft-bench, started by heft bench.")
foreach(component psychophysics inference engine physics)
  cpack_add_component(${component} GROUP library)
endforeach()
cpack_add_component_group(library DESCRIPTION "Heft's procedures, estimators, session engine and physics
C++ libraries, for find_package(heft).")
if(TARGET heft_python_module)
  cpack_add_component(python GROUP python)
  cpack_add_component_group(python DESCRIPTION "Heft's Python module
Procedures, fits, logs as pandas data frames, and simulations.")
endif()
