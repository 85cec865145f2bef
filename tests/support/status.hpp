// Statuses by name in the messages of a failed check.
#pragma once

#include "support/catch.hpp"
#include <hapbeam/force_model.hpp>

template <>
struct Catch::StringMaker<hapbeam::Status> {
  static std::string convert(hapbeam::Status status) { return hapbeam::name(status); }
};
