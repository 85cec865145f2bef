// Models that the project's own programs would compile again and again, two seconds each and file, are compiled once:
// cmake/once/*.inc has a line for each, and cmake/once.cmake makes units of the library hapbeam_once of them.
// The programs' precompiled headers include this file, which keeps them from compiling these models themselves.
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

#define HAPBEAM_ONCE extern
#include "once/mass.inc"
#include "once/plane.inc"
#include "once/rare.inc"
#include "once/rods.inc"
#include "once/svd.inc"
#undef HAPBEAM_ONCE
