// SPDX-License-Identifier: MIT
// All that a servo needs.  Included by name are training (rom/training/train.hpp, rom/training/validate.hpp), which costs an SVD; model files
// (rom/file/model_file.hpp), which need jansson; a real device (haptics/hdapi/openhaptics.hpp), which needs its maker's kit; and
// haptics/servo/real_time.hpp, which brings the system's headers.
#pragma once

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/force_error.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>
#include <hapbeam/haptics/servo/tick_times.hpp>
#include <hapbeam/many/touch_many.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/shapes.hpp>
#include <hapbeam/version.hpp>
