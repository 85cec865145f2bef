// A picture of a training, drawn by gnuplot: how fast the singular values fall, and where the force is how wrong.
#pragma once

#include "options.hpp"
#include "training.hpp"

namespace train {

/// Writes options.plot, whole or not at all.   @throws std::runtime_error, also where gnuplot is not installed
void plot(const Options& options, const Result& result);

}  // namespace train
