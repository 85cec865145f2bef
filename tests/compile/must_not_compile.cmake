# cmake -D UNIT=x.cpp -D COMPILER=c++ -D INCLUDES=a;b -D REPAIRED=1 [-D READ=x.hpp] -P must_not_compile.cmake
# Succeeds if the compiler rejects the unit with a message that matches the regular expression in the unit's line
#
#   // expect: REGEX
#
# A unit can fail for another reason than the one it is about.  One that names HAPBEAM_REPAIRED must therefore compile
# with that macro defined, so that what the macro repairs is its only fault; REPAIRED says whether this is looked at.
#
# READ is a header that is included first, for it is precompiled.
file(STRINGS ${UNIT} expect REGEX "^// expect: ")
if(NOT expect)
  message(FATAL_ERROR "${UNIT} has no line '// expect: REGEX'")
endif()
string(REPLACE "// expect: " "" expect "${expect}")
list(TRANSFORM INCLUDES PREPEND -I)
set(compile ${COMPILER} -std=c++17 -fsyntax-only -fmessage-length=0 ${INCLUDES})
if(READ)
  list(APPEND compile -include ${READ})
endif()
list(APPEND compile ${UNIT})

file(STRINGS ${UNIT} repaired REGEX HAPBEAM_REPAIRED)
if(repaired AND REPAIRED)
  execute_process(COMMAND ${compile} -DHAPBEAM_REPAIRED RESULT_VARIABLE result ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "fails with HAPBEAM_REPAIRED too:\n${output}")
  endif()
endif()

execute_process(COMMAND ${compile} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "compiles, but must not")
endif()
if(NOT output MATCHES "${expect}")
  message(FATAL_ERROR "no message matches '${expect}':\n${output}")
endif()
