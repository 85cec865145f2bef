// All that a servo needs.  Training (rom/train.hpp, rom/validate.hpp) and model files (rom/model_file.hpp)
// are included by name: they cost an SVD and one more library.  So are a real device
// (haptics/openhaptics.hpp), which needs its maker's kit, and haptics/real_time.hpp, which brings the
// system's headers.
#pragma once

#include <hapbeam/beam.hpp>
#include <hapbeam/beam_shapes.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/dense.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/exchange.hpp>
#include <hapbeam/haptics/placement.hpp>
#include <hapbeam/haptics/servo_loop.hpp>
#include <hapbeam/haptics/tick_times.hpp>
#include <hapbeam/haptics/virtual_phantom.hpp>
#include <hapbeam/rom/galerkin_model.hpp>
#include <hapbeam/rom/guarded.hpp>
#include <hapbeam/rom/pod_model.hpp>
