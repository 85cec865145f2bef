include(/usr/lib/cmake/Catch2/Catch2ConfigVersion.cmake)
