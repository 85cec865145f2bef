// SPDX-License-Identifier: MIT
// Moved to section.hpp; kept for one release.
#pragma once

#include <hapbeam/section.hpp>
