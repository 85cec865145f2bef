#include <hapbeam/hapbeam.hpp>

const char* name_of_ok() { return hapbeam::name(hapbeam::Status::ok); }
