# The C interface, used from C and from Python; both feel what a program in C++ feels.
enable_language(C)
add_executable(c_press c/press.c)
set_target_properties(c_press PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
target_link_libraries(c_press PRIVATE hapbeam::c hapbeam_checks $<$<NOT:$<BOOL:${WIN32}>>:m>)
add_executable(c_reference c/reference.cpp)
target_link_libraries(c_reference PRIVATE hapbeam_once hapbeam_checks)
target_precompile_headers(c_reference REUSE_FROM hapbeam_once)
if(HAPBEAM_SANITIZE)
  # The library's sanitizers are those of C++, which clang adds for that language alone.
  set_target_properties(c_press PROPERTIES LINKER_LANGUAGE CXX)
endif()
add_dependencies(hapbeam_tests c_press c_reference)
add_test(NAME c/press COMMAND c_press ${CMAKE_CURRENT_SOURCE_DIR}/data/models/pod_double.json)
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND AND NOT HAPBEAM_SANITIZE)
  add_test(NAME c/python COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/c/press.py
    $<TARGET_FILE:hapbeam_c> $<TARGET_FILE:c_press> $<TARGET_FILE:c_reference>)
endif()
