// Where methods fail, and what the library does there: the numbers and the charts' series of docs/where_methods_fail.md.
//
//   where_methods_fail FOLDER     writes where_methods_fail.csv and fail_*.csv there
//
// Naive methods are those of tests/support, as are the tests' that assert what is charted here.  Nothing is timed: but for
// round-off the same numbers on every machine, in some seconds.  Charts and page: where_methods_fail.sh.
#include <cstdio>

#include "failures/report.hpp"

int main(int argc, char** argv) {
  using namespace hapbeam::benchmarks;
  if (argc != 2)
    return std::fputs("where_methods_fail: must be called with a folder to write to\n", stderr), 2;
  Report report(argv[1]);
  for (const auto room : {elements, newton, training, round_off, contact, loop, steps}) room(report);
  if (!report.good()) return std::fprintf(stderr, "where_methods_fail: %s: cannot be written\n", argv[1]), 1;
  return 0;
}
