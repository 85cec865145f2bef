// SPDX-License-Identifier: MIT
// Moved to shapes.hpp; kept for one release.
#pragma once

#include <hapbeam/shapes.hpp>
