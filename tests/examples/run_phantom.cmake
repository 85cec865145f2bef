# cmake -D COMMAND=program;option;... -D STATUS=n -D OUTPUT=regex [-D REPORT=x.json] -P run_phantom.cmake
# Succeeds if the command ends with the status, prints what matches (both streams, whole), and its report has all fields.
execute_process(COMMAND ${COMMAND} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL STATUS)
  message(FATAL_ERROR "exit status ${status}, not ${STATUS}:\n${output}")
endif()
if(NOT output MATCHES "${OUTPUT}")
  message(FATAL_ERROR "the output does not match '${OUTPUT}':\n${output}")
endif()
if(REPORT)
  file(READ ${REPORT} report)
  foreach(field device beam model elements ticks missed_ticks tick_us_p50 tick_us_p99 tick_us_max max_press_mm max_force_N
      max_status)
    if(NOT report MATCHES "\"${field}\": (\"[^\"]+\"|[-+.e0-9]+)[,\n]")
      message(FATAL_ERROR "the report has no ${field}:\n${report}")
    endif()
  endforeach()
endif()
