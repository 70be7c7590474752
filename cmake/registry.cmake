# sklar_registry(FOLDER NAMESPACE TYPE SHARED NAMES...): the registry of a folder from its list of names. NAME.hpp holds in
# NAMESPACE::NAME an info() that returns TYPE; headers of SHARED are not in the list. Stops where a name has no header or
# a header no name. Writes into generated/FOLDER all.hpp, list.inc and declarations.inc (NAME_info() of all), and NAME.cpp,
# the one source that includes NAME.hpp for it; sets registry_sources to these.
function(sklar_registry folder namespace type shared)
  set(names ${ARGN})
  set(here ${PROJECT_SOURCE_DIR}/${folder})
  file(GLOB present RELATIVE ${here} CONFIGURE_DEPENDS ${here}/*.hpp)
  list(TRANSFORM present REPLACE "\\.hpp$" "")
  list(REMOVE_ITEM present ${shared})
  foreach(name IN LISTS names)
    if(NOT name IN_LIST present)
      message(FATAL_ERROR "${folder}/CMakeLists.txt lists ${name}, but ${folder}/${name}.hpp does not exist")
    endif()
  endforeach()
  foreach(name IN LISTS present)
    if(NOT name IN_LIST names)
      message(FATAL_ERROR "${folder}/${name}.hpp exists, but ${folder}/CMakeLists.txt does not list ${name}")
    endif()
  endforeach()

  set(generated ${PROJECT_BINARY_DIR}/generated/${folder})
  set(sources "")
  set(includes "")
  set(declarations "")
  set(calls "")
  foreach(name IN LISTS names)
    file(CONFIGURE OUTPUT ${generated}/${name}.cpp CONTENT [[
#include "@folder@/@name@.hpp"

namespace @namespace@ {
@type@ @name@_info() { return @name@::info(); }
}  // namespace @namespace@
]] @ONLY)
    list(APPEND sources ${generated}/${name}.cpp)
    string(APPEND includes "#include \"${folder}/${name}.hpp\"\n")
    string(APPEND declarations "${type} ${name}_info();\n")
    string(APPEND calls "      ${name}_info(),\n")
  endforeach()
  file(CONFIGURE OUTPUT ${generated}/all.hpp CONTENT "#pragma once\n// Generated from ${folder}/CMakeLists.txt.\n\n@includes@" @ONLY)
  file(CONFIGURE OUTPUT ${generated}/list.inc CONTENT "@calls@" @ONLY)
  file(CONFIGURE OUTPUT ${generated}/declarations.inc CONTENT "@declarations@" @ONLY)
  set(registry_sources ${sources} PARENT_SCOPE)
endfunction()
