#include <hapbeam/hapbeam.hpp>

const char* name_of_ok();

int main() { return name_of_ok() == nullptr; }
