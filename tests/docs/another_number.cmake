# cmake -D BASH=bash -D FILL=fill.sh -D DATA=folder -D NAME=csv -D PAGE=page -D COPY=folder -P another_number.cmake
# Succeeds if fill.sh --check fails, and names the page, where the data are others: every broken number of NAME.csv has a digit more in front.
file(REMOVE_RECURSE ${COPY})
file(COPY ${DATA}/ DESTINATION ${COPY} FILES_MATCHING PATTERN "*.csv")
file(READ ${COPY}/${NAME}.csv text)
string(REGEX REPLACE ",([0-9]+\\.[0-9])" ",9\\1" changed "${text}")
if(changed STREQUAL text)
  message(FATAL_ERROR "${NAME}.csv has no number to change")
endif()
file(WRITE ${COPY}/${NAME}.csv "${changed}")
execute_process(COMMAND ${BASH} ${FILL} --check --data ${COPY} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "--- ${PAGE}\n")
  message(FATAL_ERROR "exit status ${status}; ${PAGE} should have been said to disagree:\n${output}")
endif()
