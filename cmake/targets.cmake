# talus_library(name [COLD] SOURCES ... LINK ...) and talus_program(...): a target with the project's settings, named sources, and the
# repository's root as its only include folder.
function(talus_settings target)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE talus_warnings PUBLIC talus_numerics)
endfunction()

# With COLD nothing of it is in a loop that a run waits for: -O1 in release builds, which is quicker to compile.
function(talus_library name)
  cmake_parse_arguments(ARG "COLD" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  talus_settings(${name})
  if(ARG_COLD)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
endfunction()

# A library for programs outside of this project. EXPORTS: the version script that says which symbols it shows.
function(talus_shared_library name)
  cmake_parse_arguments(ARG "" "EXPORTS" "SOURCES;LINK" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  set(exports ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_EXPORTS})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${name} PRIVATE talus_warnings talus_numerics ${ARG_LINK})
  target_link_options(${name} PRIVATE LINKER:--version-script=${exports} LINKER:--as-needed)
  set_target_properties(${name} PROPERTIES LINK_DEPENDS ${exports} VERSION ${PROJECT_VERSION}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
endfunction()

function(talus_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  talus_settings(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
endfunction()

# A program in C, or another language that calls it, that takes part in a run.
function(talus_c_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE talus_c talus_numerics)
  if(TALUS_SANITIZE)  # the library needs the sanitizers' part for C++, which only the linker of C++ brings
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  endif()
endfunction()

# Sanitizers slow programs ten- to fiftyfold: what a test may take there.
function(talus_time_limit variable seconds)
  if(TALUS_SANITIZE)
    math(EXPR seconds "10 * ${seconds}")
  endif()
  set(${variable} ${seconds} PARENT_SCOPE)
endfunction()

# talus_test(name SOURCES ... LINK ... LABEL unit|verification|coupled|faults [THREADS] [TIMEOUT seconds]): one Catch2 program, one ctest entry
# a file of tests, so that a failure is named and files run side by side. THREADS: it uses some, so the thread sanitizer is to see it. The targets
# unit_tests, coupled_tests, ... build all programs of a label.
function(talus_test name)
  cmake_parse_arguments(ARG "SERIAL;THREADS" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  talus_settings(${name})
  target_link_libraries(${name} PRIVATE talus_test_main ${ARG_LINK})
  # Test code itself need not be fast, but there is much of it to compile.
  target_compile_options(${name} PRIVATE -O1)
  target_compile_definitions(${name} PRIVATE CATCH_CONFIG_FAST_COMPILE)
  target_compile_definitions(${name} PRIVATE TALUS_SOURCE_DIR="${PROJECT_SOURCE_DIR}" TALUS_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(NOT TARGET ${ARG_LABEL}_tests)
    add_custom_target(${ARG_LABEL}_tests)
  endif()
  add_dependencies(${ARG_LABEL}_tests ${name})
  talus_time_limit(ARG_TIMEOUT ${ARG_TIMEOUT})
  if(ARG_THREADS)
    list(APPEND ARG_LABEL threads)
  endif()
  # Sanitizers slow programs tenfold: cases that gather statistics or take 1e5 steps are left to the other builds.
  if(TALUS_SANITIZE)
    set(chosen "~[long]~[.]")
  endif()
  add_test(NAME ${name} COMMAND ${name} --durations no ${chosen})
  # Threads that wait for others sleep soon: tests run side by side on few cores.
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABEL}" TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${ARG_SERIAL} ENVIRONMENT GOMP_SPINCOUNT=1000)
endfunction()
