// A loop of known length that is to be written out: HAPBEAM_UNROLL stands before it.
//
// g++ -O2 leaves short loops over small matrices as they are, and what they touch goes through memory.
#pragma once

#if defined(__clang__)
#define HAPBEAM_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define HAPBEAM_UNROLL _Pragma("GCC unroll 16")
#else
#define HAPBEAM_UNROLL
#endif
