# Instructions of a tick, counted by callgrind: the same in each run, where a time is not.  What is counted is compiled as hapbeam_once is.
find_program(HAPBEAM_VALGRIND valgrind)
find_path(HAPBEAM_VALGRIND_INCLUDE valgrind/callgrind.h)
mark_as_advanced(HAPBEAM_VALGRIND HAPBEAM_VALGRIND_INCLUDE)
add_custom_target(test_instructions)
add_dependencies(hapbeam_tests test_instructions)

# Figures are those of one compiler, its processor and its flags: a column.
set(figures ${CMAKE_CURRENT_SOURCE_DIR}/data/instructions.csv)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${figures})
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(REGEX MATCH "^[0-9]+" version "${CMAKE_CXX_COMPILER_VERSION}")
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" flags)
string(REPLACE "-fPIC " "" flags "${flags}")  # it adds less than what is let pass
set(column "${CMAKE_CXX_COMPILER_ID} ${version} ${CMAKE_SYSTEM_PROCESSOR} ${flags}")
file(STRINGS ${figures} columns REGEX "^stroke,")
string(REPLACE "," ";" columns "${columns}")

if(NOT HAPBEAM_VALGRIND OR NOT HAPBEAM_VALGRIND_INCLUDE)
  set(skipped "valgrind and its headers are not installed")
elseif(NOT column IN_LIST columns)
  set(skipped "no figures of ${column}")
else()
  set(skipped)
endif()
if(skipped)
  add_test(NAME instructions/no_more_than_before COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${skipped}")
  set_tests_properties(instructions/no_more_than_before PROPERTIES LABELS instructions SKIP_REGULAR_EXPRESSION "^skipped: ")
  return()
endif()

file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/instructions/*.cpp)
add_executable(count_instructions ${sources})
target_link_libraries(count_instructions PRIVATE hapbeam_test_support)
target_include_directories(count_instructions SYSTEM PRIVATE ${HAPBEAM_VALGRIND_INCLUDE})
target_precompile_headers(count_instructions REUSE_FROM hapbeam_once)
add_dependencies(test_instructions count_instructions)

set(script ${CMAKE_CURRENT_SOURCE_DIR}/instructions/compare.cmake)
set(counted ${CMAKE_CURRENT_BINARY_DIR}/instructions.callgrind)
set(compare ${CMAKE_COMMAND} -D COUNTED=${counted} -D FIGURES=${figures} -D COLUMN=${column})
add_test(NAME instructions/count COMMAND ${CMAKE_COMMAND} -D VALGRIND=${HAPBEAM_VALGRIND}
  -D PROGRAM=$<TARGET_FILE:count_instructions> -D COUNTED=${counted} -P ${script})
set_tests_properties(instructions/count PROPERTIES LABELS instructions FIXTURES_SETUP instructions COST 5)
function(hapbeam_compare_instructions name percent)
  add_test(NAME instructions/${name} COMMAND ${compare} -D PERCENT=${percent} -P ${script})
  set_tests_properties(instructions/${name} PROPERTIES LABELS instructions FIXTURES_REQUIRED instructions ${ARGN})
endfunction()
hapbeam_compare_instructions(no_more_than_before 100)
# The comparison is able to fail, and sees what takes fewer, wherever within 5 % a tick is.
hapbeam_compare_instructions(more_than_before 90 PASS_REGULAR_EXPRESSION "more instructions a tick than .*PodModel: slides")
hapbeam_compare_instructions(fewer_than_before 111 PASS_REGULAR_EXPRESSION "fewer instructions a tick: .*PodModel: slides")

# After a run of instructions/count: its figures become those of this compiler.
add_custom_target(instructions_write COMMAND ${compare} -D PERCENT=100 -D WRITE=ON -P ${script} VERBATIM)
