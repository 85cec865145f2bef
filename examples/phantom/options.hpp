// The command line: what can be chosen, in which unit, and one line for whoever chose wrongly.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/beam.hpp>

namespace phantom {

/// A wrong command line; what() is one line that says what is allowed.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class ElementChoice { linear, full, reduced, assumed_strain };
enum class Script { slide, press, tap };

/// Everything in SI.
struct Options {
  std::string beam = "thesis";  ///< a name, or "custom" where a figure of it was changed
  double length, width, height, young;
  hapbeam::Support left, right;
  ElementChoice element = ElementChoice::assumed_strain;
  int elements = 16;

  Script script = Script::slide;
  double place;            ///< [m] from the left end
  double depth = 0.03;     ///< [m] that the hand aims below the beam's surface
  double duration = 10;    ///< [s]
  double radius = 0.005;   ///< [m] of the avatar
  double scale = 1;        ///< metres of the scene for one of the device
  bool lock_step = false;  ///< simulated time, as fast as the machine can
  std::string report;      ///< file, or empty

  hapbeam::Beam make_beam() const;
};

/// Names as they are typed.
const char* name(ElementChoice element);
const char* name(Script script);

/// @throws UsageError
Options parse(const std::vector<std::string>& arguments);

/// True where help is asked for, whatever else is.
bool wants_help(const std::vector<std::string>& arguments);
std::string help();

}  // namespace phantom
