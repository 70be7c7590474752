# sklar_library(NAME): a library target sklar_NAME, exported as sklar::NAME, with the project's warnings and language level.
include(GNUInstallDirs)

function(sklar_compile_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # The three that are off for GCC: 12 sees overlaps and overflows in std::string's operator+ that are not there (GCC bug
  # 105651), the last two where <string> is precompiled.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>
                                           $<$<BOOL:${SKLAR_WERROR}>:-Werror>)
endfunction()

# sklar_precompile(TARGET headers...): what nearly every source includes, and the headers given, are parsed once.
function(sklar_precompile target)
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <functional> <memory> <span> <stdexcept> <string>
                                              <vector> <Eigen/Geometry> ${ARGN})
endfunction()

# sklar_source_options("OPTION;.." sources...): options of single sources. They go without the precompiled headers, for with
# these GCC compiles as the headers were compiled: -ffp-contract=off, for one, is lost without a word.
function(sklar_source_options options)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

function(sklar_library name)
  add_library(sklar_${name} ${ARGN})
  add_library(sklar::${name} ALIAS sklar_${name})
  set_target_properties(sklar_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  sklar_compile_settings(sklar_${name})
  sklar_precompile(sklar_${name})
  target_include_directories(sklar_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/sklar>)
endfunction()
