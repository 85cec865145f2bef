// What the user sees: the plan, how far the presses are, what came out of them.
#pragma once

#include <string>

#include "options.hpp"
#include "training.hpp"

namespace train {

void print_plan(const Options& options);

/// A bar on a terminal, which is drawn over itself; elsewhere a line for each quarter.
class ProgressBar {
 public:
  explicit ProgressBar(const char* what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(int done, int total);

 private:
  const char* what_;
  bool terminal_;
  int shown_ = -1;     // hundredths, or quarters
  bool open_ = false;  // the cursor is on the bar's line
};

void print_result(const Options& options, const Result& result);
/// @param bytes  of the file   @param seconds  that writing it took
void print_file(const Options& options, const Result& result, unsigned long long bytes, double seconds);

}  // namespace train
