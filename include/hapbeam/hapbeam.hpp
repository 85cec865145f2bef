// The whole library.
#pragma once

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/dense.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/virtual_phantom.hpp>
