# hapbeam_once: what once/*.inc lists, compiled once for tests and examples, as a user compiles it.  A list is a unit.
# Its objects come first in the link of a program that leaves its own copies unoptimised: the linker keeps the first.
find_package(Threads REQUIRED)
# Programs that are compiled for minutes and run for seconds.  g++ optimises them, for the warnings that come with it.
set(in_release $<AND:$<CONFIG:Release>,$<NOT:$<CXX_COMPILER_ID:MSVC>>>)
if(HAPBEAM_SANITIZE)
  set(in_release 1)  # what is compiled once is optimised there, too
endif()
set(quick_to_compile $<${in_release}:-O$<IF:$<CXX_COMPILER_ID:Clang,AppleClang>,0,1>>)
function(hapbeam_once_units variable header)
  set(units)
  foreach(name IN LISTS ARGN)
    set(unit ${PROJECT_BINARY_DIR}/once/${name}.cpp)
    file(GENERATE OUTPUT ${unit}
      CONTENT "#include \"${header}\"\n#define HAPBEAM_ONCE\n#include \"once/${name}.inc\"\n")
    list(APPEND units ${unit})
  endforeach()
  set(${variable} ${units} PARENT_SCOPE)
endfunction()
# Those that take longest come first, so that nobody waits for them alone.
set(models several_rods twisted_rod round_rod several rare von_karman touch corotational reduced servo)
if(HAPBEAM_SANITIZE STREQUAL "thread")
  list(REMOVE_ITEM models rare)  # no program that starts threads has them
endif()
hapbeam_once_units(models once.hpp ${models} svd)
if(HAPBEAM_SANITIZE STREQUAL "thread")
  # What is pressed there for an instant.  What is precompiled differs in __OPTIMIZE__ alone.
  set(rods ${models})
  list(FILTER rods INCLUDE REGEX "_rods?[.]cpp$")
  set_source_files_properties(${rods} PROPERTIES COMPILE_OPTIONS "-O0;-Xclang;-fno-validate-pch")
endif()
hapbeam_once_units(training once_training.hpp training scene)
add_library(hapbeam_once STATIC ${models} ${training})
target_include_directories(hapbeam_once PUBLIC ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(hapbeam_once PUBLIC hapbeam::hapbeam Threads::Threads PRIVATE hapbeam_checks)
target_precompile_headers(hapbeam_once PRIVATE ${CMAKE_CURRENT_LIST_DIR}/once.hpp)

# Small programs, of the same flags, read Eigen precompiled for the first of them.
function(hapbeam_precompile_eigen target)
  get_property(first GLOBAL PROPERTY hapbeam_precompiled_eigen)
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY hapbeam_precompiled_eigen ${target})
    target_precompile_headers(${target} PRIVATE <Eigen/Core>)
  endif()
endfunction()
