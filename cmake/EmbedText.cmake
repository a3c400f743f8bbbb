# SPDX-License-Identifier: Apache-2.0
# Text files inside the program. At configure time this file gives
#
#   embed_text(<target> HEADER module/embedded.h NAMESPACE skysweep::module FILES a.toml b.toml)
#
# which adds to the target a generated source with the definitions of two functions that HEADER declares:
#   std::optional<std::string_view> embedded_file(std::string_view name);
#   std::vector<std::string_view> embedded_file_names();
# At build time the same file, run by `cmake -P`, writes that source.

function(embed_text target)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "FILES" ${ARGN})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded.cpp)
  list(TRANSFORM ARG_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
  list(SORT ARG_FILES COMPARE FILE_BASENAME)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${ARG_HEADER} -DNAMESPACE=${ARG_NAMESPACE} "-DFILES=${ARG_FILES}"
            -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${ARG_FILES} ${CMAKE_CURRENT_FUNCTION_LIST_FILE} VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  return()
endif()

set(entries "")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  if(text MATCHES "\\)embed~\"")
    message(FATAL_ERROR "${path} holds the character sequence that ends an embedded text; change it there")
  endif()
  string(APPEND entries "    {\"${name}\", R\"embed~(${text})embed~\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/EmbedText.cmake; do not edit.
#include \"${HEADER}\"

#include <array>
#include <utility>

namespace ${NAMESPACE} {

namespace {

constexpr auto kFiles = std::to_array<std::pair<std::string_view, std::string_view>>({
${entries}});

}  // namespace

std::optional<std::string_view> embedded_file(std::string_view name) {
  for (const auto& [file, text] : kFiles)
    if (file == name) return text;
  return std::nullopt;
}

std::vector<std::string_view> embedded_file_names() {
  std::vector<std::string_view> names;
  for (const auto& file : kFiles) names.push_back(file.first);
  return names;
}

}  // namespace ${NAMESPACE}
")
