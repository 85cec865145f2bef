# cmake -D A=file -D B=file -P same_files.cmake: succeeds if both are the same to the last byte, and not empty.
file(SHA256 ${A} a)
file(SHA256 ${B} b)
file(SIZE ${A} size)
if(NOT a STREQUAL b OR size EQUAL 0)
  message(FATAL_ERROR "${A} and ${B} differ")
endif()
