# hapbeam_checks: the warnings and sanitizers of this project's own programs.  Never exported: a user's flags are
# the user's.
add_library(hapbeam_checks INTERFACE)

if(MSVC)
  # Sources are UTF-8, a unit has more sections than its format counts, and M_PI is asked for.
  target_compile_options(hapbeam_checks INTERFACE /W4 /permissive- /utf-8 /bigobj $<$<BOOL:${HAPBEAM_WARNINGS_AS_ERRORS}>:/WX>)
  target_compile_definitions(hapbeam_checks INTERFACE _USE_MATH_DEFINES)
elseif(HAPBEAM_BUILD_TESTS OR HAPBEAM_WARNINGS_AS_ERRORS)
  # They take time to compile, and who builds no tests runs the programs and does not change them.
  set(hapbeam_warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  target_compile_options(hapbeam_checks INTERFACE ${hapbeam_warnings} $<$<BOOL:${HAPBEAM_WARNINGS_AS_ERRORS}>:-Werror>)
endif()

# g++ collects its garbage from 128 MB on, an eighth of the time of a test with many models; left alone it takes a seventh more memory.
target_compile_options(hapbeam_checks INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=4000000>)

# Programs with many models link in a third of the time or less by another linker than the usual one.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT CMAKE_CROSSCOMPILING)
  find_program(HAPBEAM_LINKER NAMES ld.lld ld.gold)
  mark_as_advanced(HAPBEAM_LINKER)
  if(HAPBEAM_LINKER)
    string(REGEX REPLACE ".*ld[.]" "" linker ${HAPBEAM_LINKER})
    target_link_options(hapbeam_checks INTERFACE -fuse-ld=${linker})
  endif()
endif()

if(HAPBEAM_SANITIZE)
  target_compile_options(hapbeam_checks INTERFACE
    -fsanitize=${HAPBEAM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_libraries(hapbeam_checks INTERFACE -fsanitize=${HAPBEAM_SANITIZE})
  # What the address sanitizer or Eigen's own assertions see as well is not looked for twice: half of the compiler's time.
  if(HAPBEAM_SANITIZE STREQUAL "address,undefined")
    target_compile_options(hapbeam_checks INTERFACE -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow)
  endif()
endif()

# Compiles a target for this machine's processor, where the compiler knows it.
include(CheckCXXCompilerFlag)
function(hapbeam_compile_native target)
  check_cxx_compiler_flag(-march=native HAPBEAM_KNOWS_NATIVE)
  if(HAPBEAM_NATIVE AND HAPBEAM_KNOWS_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
endfunction()
