# cmake -D BASH=bash -D CHECK=rooms.sh -D HEADERS=folder -D COPY=folder -D HEADER=path -D INCLUDE=path -D WHY=regex -P planted.cmake
# Succeeds if the check fails, and says WHY, where HEADER includes INCLUDE too.
file(REMOVE_RECURSE ${COPY})
file(COPY ${HEADERS}/ DESTINATION ${COPY})
file(APPEND ${COPY}/${HEADER} "#include <hapbeam/${INCLUDE}>\n")
execute_process(COMMAND ${BASH} ${CHECK} --headers ${COPY} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "${WHY}")
  message(FATAL_ERROR "exit status ${status}; '${WHY}' should have been said:\n${output}")
endif()
