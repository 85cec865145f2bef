// Catch2's own main, for a Catch2 2 that is installed without it.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
