#include <hapbeam/hapbeam.hpp>

#ifdef JANSSON_H
#error "hapbeam.hpp asks for jansson, which only model files need"
#endif

const char* name_of_ok();

int main() { return name_of_ok() == nullptr; }
