# Catch2 2.13 for a cross compiler.  Its header lies beside those of this machine's C library, which another system's compiler
# must not see, so it is copied.
file(COPY /usr/include/catch2/catch.hpp DESTINATION ${CMAKE_BINARY_DIR}/catch2/catch2)
add_library(Catch2::Catch2 INTERFACE IMPORTED)
set_target_properties(Catch2::Catch2 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_BINARY_DIR}/catch2)
list(APPEND CMAKE_MODULE_PATH /usr/lib/cmake/Catch2)
