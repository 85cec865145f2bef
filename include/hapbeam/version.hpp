// SPDX-License-Identifier: MIT
// The version, for a program that has to know: HAPBEAM_VERSION >= 100 is 0.1.0 or later.
#pragma once

#define HAPBEAM_VERSION_MAJOR 0
#define HAPBEAM_VERSION_MINOR 2
#define HAPBEAM_VERSION_PATCH 0
#define HAPBEAM_VERSION (HAPBEAM_VERSION_MAJOR * 10000 + HAPBEAM_VERSION_MINOR * 100 + HAPBEAM_VERSION_PATCH)
