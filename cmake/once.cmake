# hapbeam_once: what once/*.inc lists, compiled once for tests and examples, as a user compiles it.
# Its objects come first in the link of a program that leaves its own copies unoptimised: the linker keeps the first.
find_package(Threads REQUIRED)
# Programs that are compiled for minutes and run for seconds.  g++ optimises them, for the warnings that come with it.
set(in_release $<AND:$<CONFIG:Release>,$<NOT:$<CXX_COMPILER_ID:MSVC>>>)
if(HAPBEAM_SANITIZE)
  set(in_release 1)  # what is compiled once is optimised there, too
endif()
set(quick_to_compile $<${in_release}:-O$<IF:$<CXX_COMPILER_ID:Clang,AppleClang>,0,1>>)
# hapbeam_once_header(VARIABLE TEXT): the header that declares what a program with this text takes of it.
function(hapbeam_once_header variable text)
  set(header once.hpp)
  if(text MATCHES "hapbeam/(scene|rom/training)/")
    set(header once_training.hpp)
  elseif(text MATCHES "hapbeam/world/|held_rod.hpp")
    set(header once_world.hpp)
  endif()
  set(${variable} ${header} PARENT_SCOPE)
endfunction()
# hapbeam_once_unit(VARIABLE HEADER LIST...): lists that instantiate the same, in one unit, do so once: all rods take half of their sum.
function(hapbeam_once_unit variable header)
  list(GET ARGN 0 name)
  list(TRANSFORM ARGN REPLACE "(.+)" "#include \"once/\\1.inc\"" OUTPUT_VARIABLE lists)
  list(JOIN lists "\n" lists)
  set(unit ${PROJECT_BINARY_DIR}/once/${name}.cpp)
  file(GENERATE OUTPUT ${unit} CONTENT "#include \"${header}\"\n#define HAPBEAM_ONCE\n${lists}\n")
  set(${variable} ${${variable}} ${unit} PARENT_SCOPE)
endfunction()
# Those that take longest come first, so that nobody waits for them alone.
set(rare rare)
set(modes modes)
if(HAPBEAM_SANITIZE STREQUAL "thread")
  set(rare)  # no program that starts threads has them
  set(modes)
endif()
hapbeam_once_unit(models once_world.hpp rods world)
if(HAPBEAM_SANITIZE STREQUAL "thread")
  # What is pressed there for an instant.  What is precompiled differs in __OPTIMIZE__ alone.
  set_source_files_properties(${models} PROPERTIES COMPILE_OPTIONS "-O0;-Xclang;-fno-validate-pch")
endif()
hapbeam_once_unit(models once.hpp plane mass ${rare})
hapbeam_once_unit(models once_training.hpp training ${modes})
hapbeam_once_unit(models once.hpp svd)
hapbeam_once_unit(models once_training.hpp scene)
# Built for who links it: libhapbeam alone takes none of it.
add_library(hapbeam_once STATIC EXCLUDE_FROM_ALL ${models})
target_include_directories(hapbeam_once PUBLIC ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(hapbeam_once PUBLIC hapbeam::hapbeam Threads::Threads PRIVATE hapbeam_checks)
target_precompile_headers(hapbeam_once PRIVATE ${CMAKE_CURRENT_LIST_DIR}/once.hpp)

# What reads that in programs that are tested and not used.  g++ takes the level of what is precompiled, so there it is precompiled at theirs.
set(hapbeam_tested hapbeam_once)
if(HAPBEAM_TESTED_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(hapbeam_tested hapbeam_once_tested)
  set(nothing ${PROJECT_BINARY_DIR}/once/nothing.cpp)
  file(GENERATE OUTPUT ${nothing} CONTENT "")
  add_library(hapbeam_once_tested OBJECT ${nothing})
  target_link_libraries(hapbeam_once_tested PRIVATE hapbeam_once hapbeam_checks)
  target_compile_options(hapbeam_once_tested PRIVATE ${HAPBEAM_TESTED_LEVEL})
  target_precompile_headers(hapbeam_once_tested PRIVATE ${CMAKE_CURRENT_LIST_DIR}/once.hpp)
endif()

# clang instantiates what tests/support/used.hpp uses with the tests' precompiled header, and compiles it once for all that read it.  The thread
# sanitizer's tests are too few.
set(hapbeam_instantiated)
if(HAPBEAM_BUILD_TESTS AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14 AND UNIX AND NOT APPLE
   AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS AND NOT HAPBEAM_SANITIZE STREQUAL "thread")
  set(hapbeam_instantiated ${PROJECT_BINARY_DIR}/tests/CMakeFiles/hapbeam_test_precompiled.dir/cmake_pch.hxx.pch)
endif()
# hapbeam_read_instantiated(TARGET FILE...): these files of a program read that header, and its program is linked with what it defines.
# Other flags, as __OPTIMIZE__, are not looked at.
function(hapbeam_read_instantiated target)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON OBJECT_DEPENDS ${hapbeam_instantiated})
  set_property(SOURCE ${ARGN} APPEND PROPERTY
    COMPILE_OPTIONS -Xclang -fno-validate-pch -Xclang -include-pch -Xclang ${hapbeam_instantiated})
  hapbeam_link_instantiated(${target})
endfunction()
function(hapbeam_link_instantiated target)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:hapbeam_test_used>)
  # What was only asked for its type is there, too, and lacks what it would call.
  target_link_options(${target} PRIVATE -Wl,--gc-sections)
endfunction()

# Small programs, of the same flags, read Eigen precompiled for the first of them, and hapbeam.hpp where they include it: other headers would hide
# what they forget to include.  Where another build looks at that, they read all that is precompiled, for tests if these are built, which differs in
# __OPTIMIZE__ alone.
function(hapbeam_precompile_included target text)
  set(header <Eigen/Core>)
  if(text MATCHES "#include <hapbeam/hapbeam.hpp>")
    set(header <hapbeam/hapbeam.hpp>)
  endif()
  get_property(first GLOBAL PROPERTY hapbeam_precompiled_${header})
  if(NOT HAPBEAM_CHECK_INCLUDES AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    if(hapbeam_instantiated)
      get_target_property(files ${target} SOURCES)
      hapbeam_read_instantiated(${target} ${files})
    else()
      target_compile_options(${target} PRIVATE -Xclang -fno-validate-pch)
      target_precompile_headers(${target} REUSE_FROM hapbeam_once)
    endif()
  elseif(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY hapbeam_precompiled_${header} ${target})
    target_precompile_headers(${target} PRIVATE ${header})
  endif()
endfunction()
