# sklar_embed(HEADER NAMESPACE NAME=FILE[,FILE...]...): writes generated/SOURCE of the functions that HEADER declares in
# NAMESPACE, std::string_view NAME() for the bytes of its files one after another; sets embedded_source to its path.
function(sklar_embed header namespace)
  set(definitions "")
  foreach(entry IN LISTS ARGN)
    string(REGEX MATCH "^([a-z_]+)=(.+)$" unused "${entry}")
    set(name ${CMAKE_MATCH_1})
    string(REPLACE "," ";" files "${CMAKE_MATCH_2}")
    set(hex "")
    foreach(file IN LISTS files)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
      file(READ ${file} bytes HEX)
      string(APPEND hex "${bytes}")
    endforeach()
    string(REGEX REPLACE "(..)" "0x\\1," hex "${hex}")
    string(APPEND definitions "
std::string_view ${name}() {
  static constexpr unsigned char kBytes[] = {${hex}};
  return {reinterpret_cast<const char*>(kBytes), sizeof kBytes};
}
")
  endforeach()
  string(REGEX REPLACE "hpp$" "cpp" source ${header})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${source} CONTENT [[
#include "@header@"

namespace @namespace@ {
@definitions@
}  // namespace @namespace@
]] @ONLY)
  set(embedded_source ${PROJECT_BINARY_DIR}/generated/${source} PARENT_SCOPE)
endfunction()
