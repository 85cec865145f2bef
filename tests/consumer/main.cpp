#include <hapbeam/hapbeam.hpp>

#ifdef JANSSON_H
#error "hapbeam.hpp asks for jansson, which only model files need"
#endif

int main() { return hapbeam::name(hapbeam::Status::ok) == nullptr; }
