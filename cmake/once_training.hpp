// As once.hpp, for what trains and chooses models.  Reading it takes most of a second, so that only those who train include it.
#pragma once

#include "once.hpp"
#include <hapbeam/rom/training/modes.hpp>
#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/rom/training/validate.hpp>
#include <hapbeam/scene/build.hpp>
#include <hapbeam/scene/pilot.hpp>

#define HAPBEAM_ONCE extern
#include "once/modes.inc"
#include "once/scene.inc"
#include "once/training.inc"
#undef HAPBEAM_ONCE
