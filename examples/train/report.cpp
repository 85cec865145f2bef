#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace train {

namespace {

/// What l modes leave out, as a part of all:  √(Σ_{i>l} σ_i² / Σ σ_i²).
double left_out(const std::vector<double>& sigma, int modes) {
  double all = 0, left = 0;
  // Small ones first, for round-off.
  for (std::size_t i = sigma.size(); i-- > 0;) {
    all += sigma[i] * sigma[i];
    if (i >= static_cast<std::size_t>(modes)) left = all;
  }
  return std::sqrt(left / all);
}

std::string criterion(const Options& o) {
  switch (o.keep) {
    case Keep::modes: return "--modes " + std::to_string(o.modes);
    case Keep::energy: return "--energy " + cli::digits(o.energy);
    case Keep::error: break;
  }
  return "--error " + cli::digits(o.left_out);
}

void print_decay(const Options& o, const Result& r) {
  const int all = static_cast<int>(r.singular_values.size());
  std::printf("\nmodes    %d of %d kept (%s)\n\n%9s %16s %14s\n", r.modes, all, criterion(o).c_str(), "mode",
              "sigma_i/sigma_1", "left out");
  // All of the first, then ever fewer; the last that is kept is always there.
  int previous = 0;
  for (int mode = 1; mode <= r.modes; ++mode) {
    if (mode != r.modes && mode > 8 && mode < previous + previous / 2) continue;
    std::printf("%9d %16.2e %14.2e\n", mode,
                r.singular_values[static_cast<std::size_t>(mode - 1)] / r.singular_values[0],
                left_out(r.singular_values, mode));
    previous = mode;
  }
}

void print_regions(const hapbeam::ErrorReport& report) {
  std::printf("\n%19s %17s %8s  %10s %10s %10s %10s\n", "position mm", "depth mm", "presses", "force max",
              "95 %", "median", "shape max");
  for (const hapbeam::RegionError& region : report.regions) {
    const hapbeam::ErrorSummary& e = region.errors;
    if (e.presses == 0) continue;
    std::printf("%8.1f to %7.1f %7.2f to %6.2f %8d  %10.1e %10.1e %10.1e %10.1e\n", region.s_min * 1e3,
                region.s_max * 1e3, region.depth_min * 1e3, region.depth_max * 1e3, e.presses, e.force_max,
                e.force_p95, e.force_median, e.shape_max);
  }
}

}  // namespace

void print_plan(const Options& o) {
  std::printf("beam     %s\n", cli::describe(o.beam).c_str());
  std::printf("model    %s in %s, %d segments\n", name(o.kind), name(o.scalar), o.segments);
  if (o.single_place()) std::printf("plan     at %.1f mm", o.from * 1e3);
  else std::printf("plan     from %.1f to %.1f mm, %d positions", o.from * 1e3, o.to * 1e3, o.positions);
  std::printf(", up to %g mm deep, %d %s; full model of %d elements\n", o.depth * 1e3, o.depths,
              o.kind == Kind::pod ? "depths" : "tensions", o.elements);
  std::fflush(stdout);
}

ProgressBar::ProgressBar(const char* what) : what_(what), terminal_(isatty(STDOUT_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (open_) std::printf("\n");
  std::fflush(stdout);
}

void ProgressBar::show(int done, int total) {
  const int step = done * (terminal_ ? 100 : 4) / total;
  if (step == shown_) return;
  shown_ = step;
  if (terminal_) {
    std::string bar(40, '.');
    std::fill_n(bar.begin(), done * 40 / total, '#');
    std::printf("\r%-8s [%s] %d of %d", what_, bar.c_str(), done, total);
    open_ = done < total;
    if (!open_) std::printf("\n");
  } else if (step > 0) {
    std::printf("%-8s %d of %d\n", what_, done, total);
  }
  std::fflush(stdout);
}

void print_result(const Options& o, const Result& r) {
  print_decay(o, r);
  const hapbeam::ErrorSummary& e = r.errors.all;
  std::printf("\nerror    on %d presses that were held out, from %s\n", e.presses,
              r.errors.reference.c_str());
  std::printf("force    max %.1e, 95 %% %.1e, median %.1e of the force\n", e.force_max, e.force_p95,
              e.force_median);
  std::printf("bound    %.1e of the force anywhere in range, %.1e of it the full model's own error\n",
              r.errors.force_bound, r.errors.reference_error);
  std::printf("shape    max %.1e, median %.1e of the largest deflection\n", e.shape_max, e.shape_median);
  print_regions(r.errors);
}

void print_file(const Options& o, const Result& r, unsigned long long bytes, double seconds) {
  std::printf("\ntime     ");
  for (const Stage& stage : r.stages) std::printf("%s %.3f s, ", stage.name.c_str(), stage.seconds);
  std::printf("file %.3f s\n", seconds);
  std::printf("file     %s, %.1f kB\n", o.output.c_str(), static_cast<double>(bytes) / 1e3);
}

}  // namespace train
