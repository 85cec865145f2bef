# 64-bit ARM, by Debian's cross compiler.  The programs run under qemu-user.
#
#   cmake -S . -B build/aarch64 --toolchain cmake/toolchains/aarch64.cmake      or: bash tests/run.sh --preset aarch64
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
find_program(HAPBEAM_QEMU qemu-aarch64 NO_CMAKE_FIND_ROOT_PATH)
set(CMAKE_CROSSCOMPILING_EMULATOR ${HAPBEAM_QEMU};-L;/usr/aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/of_this_machine.cmake)
