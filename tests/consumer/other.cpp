// A second unit that includes everything: a function that is not inline is defined twice.
#include <hapbeam/hapbeam.hpp>
