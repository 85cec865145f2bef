// SPDX-License-Identifier: MIT
// Moved to support.hpp; kept for one release.
#pragma once

#include <hapbeam/support.hpp>
