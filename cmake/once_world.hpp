// As once.hpp, for rods that touch each other.  Reading it takes a second, so that only those who have such include it.
#pragma once

#include "once.hpp"
#include <hapbeam/world/world.hpp>

#define HAPBEAM_ONCE extern
#include "once/world.inc"
#undef HAPBEAM_ONCE
