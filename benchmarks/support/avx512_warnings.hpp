// Comes before Eigen.  GCC 12 takes the undefined lanes of its own AVX-512 intrinsics for a mistake (GCC bug 105593); the
// warning comes from inlining, after any pop, so that it is off for the rest of the file.
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
