# Windows, by the cross compiler MinGW-w64.  The programs run under Wine.
#
#   cmake -S . -B build/mingw --toolchain cmake/toolchains/mingw.cmake      or: bash tests/run.sh --preset mingw
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
# "posix" is the kind with <thread> and <mutex>.
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# A program needs no library of the compiler beside it.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
find_program(HAPBEAM_WINE NAMES wine64 wine PATHS /usr/lib/wine NO_CMAKE_FIND_ROOT_PATH)
set(CMAKE_CROSSCOMPILING_EMULATOR ${HAPBEAM_WINE})
include(${CMAKE_CURRENT_LIST_DIR}/of_this_machine.cmake)
