# The Debian package: `./talus package` builds what it needs and calls cpack -G DEB.
set(control_files postinst prerm triggers)
add_custom_target(man
  COMMAND ${TALUS_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/man_pages.py ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${PROJECT_VERSION} ${CMAKE_BINARY_DIR}/man/man1
  COMMENT "Manual pages from the help texts")
add_dependencies(man talus dem_solver fem_solver)
add_custom_target(packaged)
add_dependencies(packaged man homogenise_net talus_c talus_participant)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME talus)
set(CPACK_PACKAGE_CONTACT "Talus maintainers <maintainers@talus.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "rocks that hit flexible barriers: particles and structure, coupled")
set(CPACK_PACKAGE_DESCRIPTION "Computes rocks that hit nets, ropes and membranes: discrete elements and finite\nelements, coupled over shared memory, with interfaces in C, C++, Fortran and\nPython for other solvers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libopenblas0-serial)
if(TARGET talus_python)
  add_dependencies(packaged talus_python)
  find_package(Python REQUIRED COMPONENTS Interpreter)  # the compiled module is for one version of it
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", python3-scipy")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, gfortran, paraview")
# Which package holds libtalus_c, for those who package programs that use it; ldconfig is a trigger.
file(WRITE ${CMAKE_BINARY_DIR}/debian/shlibs "libtalus_c ${PROJECT_VERSION_MAJOR} talus (>= ${PROJECT_VERSION})\n")
list(TRANSFORM control_files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian/)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${control_files} ${CMAKE_BINARY_DIR}/debian/shlibs)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
