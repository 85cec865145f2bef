# Said to a project that uses hapbeam and compiles without optimisation, because it has chosen no build type.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "[-/]O")
  message(WARNING "hapbeam: CMAKE_BUILD_TYPE is empty, so nothing is optimised and a tick takes a hundred times as long. \
Configure with -DCMAKE_BUILD_TYPE=Release")
endif()
