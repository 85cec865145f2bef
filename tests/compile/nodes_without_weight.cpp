// expect: a Nodes policy needs static node\(int k, int n\) -> double, weight\(int k, int n\) -> double and name\(\)
#include <hapbeam/rom/trained/lagrange.hpp>

using namespace hapbeam;

struct Halfway {
  static constexpr const char* name() noexcept { return "halfway"; }
  static double node(int k, int n) { return ChebyshevNodes::node(k, n); }
#ifdef HAPBEAM_REPAIRED
  static double weight(int k, int n) { return ChebyshevNodes::weight(k, n); }
#endif
};

int main() { return Lagrange<Halfway>(3, 0, 1).size(); }
