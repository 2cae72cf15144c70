# Where `cmake --install` puts what. Nothing of it holds the prefix: a folder with all of it may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(include_folder ${CMAKE_INSTALL_INCLUDEDIR}/talus)
set(data_folder ${CMAKE_INSTALL_DATADIR}/talus)

install(TARGETS talus dem_solver fem_solver homogenise_net)
if(TALUS_FASTER_BUILD)  # a build for x86-64-v3, whose programs those of this build become where the processor has it
  foreach(program talus dem_solver fem_solver homogenise_net)
    install(PROGRAMS ${TALUS_FASTER_BUILD}/bin/${program} DESTINATION lib/talus/x86-64-v3/bin)
  endforeach()
endif()

# For those who write participants: find_package(talus) gives talus::c and talus::participant, pkg-config talus-c and talus-participant.
install(TARGETS talus_c talus_participant EXPORT talus INCLUDES DESTINATION ${include_folder})
foreach(header coupler/c_api/talus.h coupler/participant.hpp core/errors.hpp core/output/source.hpp interface_mesh/surface.hpp)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${include_folder}/${folder})
endforeach()
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
install(EXPORT talus NAMESPACE talus:: FILE talus-config.cmake DESTINATION ${package_folder})
write_basic_package_version_file(talus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus-config-version.cmake DESTINATION ${package_folder})

file(RELATIVE_PATH up_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
function(talus_pkg_config name description)
  file(CONFIGURE OUTPUT ${name}.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@up_to_prefix@
Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Cflags: -I${prefix}/@include_folder@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@ -l@library@
]])
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
set(library talus_c)
talus_pkg_config(talus-c "take part in coupled Talus runs, in C")
set(library talus_participant)
talus_pkg_config(talus-participant "take part in coupled Talus runs, in C++20")

if(TARGET talus_python)
  set(python_folder ${TALUS_PYTHON_PACKAGES}/talus_participant)
  install(TARGETS talus_python DESTINATION ${python_folder})
  install(DIRECTORY python/participant/ DESTINATION ${python_folder} FILES_MATCHING PATTERN *.py PATTERN native EXCLUDE PATTERN __pycache__ EXCLUDE)
endif()

# Scenes and first programs beside each other as in the tree, since scenes name files by their place.
install(DIRECTORY configs python examples DESTINATION ${data_folder}
        PATTERN __pycache__ EXCLUDE PATTERN CMakeLists.txt EXCLUDE PATTERN participant EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
install(FILES README.md cmake/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${CMAKE_BINARY_DIR}/man DESTINATION ${CMAKE_INSTALL_MANDIR}/.. OPTIONAL)
