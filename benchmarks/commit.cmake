# cmake -D SOURCE=folder -D HEADER=commit.hpp -P commit.cmake
# Runs in each build, as configuring can be older than the commit that is built; the header changes only if its text does.
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit RESULT_VARIABLE result OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT result EQUAL 0)
  set(commit unknown)
endif()
file(WRITE ${HEADER}.new "#define HAPBEAM_COMMIT \"${commit}\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -E copy_if_different ${HEADER}.new ${HEADER})
