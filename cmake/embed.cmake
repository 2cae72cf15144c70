# talus_embed(target FILE path NAMESPACE talus::page SYMBOL frame): the file's text as `extern const char* const` in the target, so that
# programs need no files beside them.
function(talus_embed target)
  cmake_parse_arguments(ARG "" "FILE;NAMESPACE;SYMBOL" "" ${ARGN})
  file(READ ${ARG_FILE} text)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${ARG_SYMBOL}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT
"namespace @ARG_NAMESPACE@ {
extern const char* const @ARG_SYMBOL@;
const char* const @ARG_SYMBOL@ = R\"embedded(@text@)embedded\";
}
")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARG_FILE})
  target_sources(${target} PRIVATE ${source})
endfunction()
