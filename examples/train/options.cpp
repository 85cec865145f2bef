#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace train {

namespace {

using cli::count, cli::figure, cli::file, cli::one_of;

constexpr Kind kinds[] = {Kind::pod, Kind::galerkin};
constexpr Scalar scalars[] = {Scalar::double_precision, Scalar::single_precision};
constexpr double unset = std::numeric_limits<double>::quiet_NaN();

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// One of the three ways to truncate.
cli::Entry keep(Options& o, Keep way, cli::Entry entry) {
  entry.set = [&o, way, set = entry.set](const std::string& value) {
    set(value);
    o.keep = way;
  };
  return entry;
}

cli::Entries entries(Options& o) {
  cli::Entries list = cli::beam_entries(o.beam);
  const cli::Entries own = {
      {"--kind", "KIND",
       "pod (default): interpolates force and shape;  galerkin: interpolates stiffness and solves for the "
       "tension",
       [&o](const std::string& v) { o.kind = one_of(kinds, "--kind", v); }},
      {"--scalar", "TYPE", "double (default) or float: what the model computes in; phantom takes double",
       [&o](const std::string& v) { o.scalar = one_of(scalars, "--scalar", v); }},
      figure(
          "--from", "M",
          "left end of the range of positions [m]; by default 5 % of the length, or 0 where that end yields",
          o.from, 0, 100, "m"),
      figure("--to", "M",
             "right end of it [m]; by default 95 % of the length, or all of it where that end yields", o.to,
             0, 100, "m"),
      figure("--at", "M", "a single place instead of a range [m]", o.from, 0, 100, "m"),
      figure("--depth", "M", "deepest press, either way [m]; a fiftieth of the length by default", o.depth,
             1e-6, 10, "m"),
      count("--positions", "positions of the grid of presses, 2 to 64; 16 by default", o.positions, 2, 64),
      count("--depths", "depths at each (of galerkin: tensions), 2 to 64; 12 by default", o.depths, 2, 64),
      count("--segments", "pieces of the shape, an even number, 2 to 1024; 32 by default", o.segments, 2,
            1024),
      keep(o, Keep::modes, count("--modes", "modes of the shape to keep, 1 to 1024", o.modes, 1, 1024)),
      keep(o, Keep::error,
           figure("--error", "X",
                  "or the fewest that leave out at most this part of all shapes, 0 to 0.5; 1e-4 by default",
                  o.left_out, 0, 0.5, "")),
      keep(o, Keep::energy,
           figure("--energy", "X", "or the fewest that hold this part of its square, 0.5 to 1", o.energy, 0.5,
                  1, "")),
      count("--elements",
            "finite elements of the full model, 2 to 4096; 256 by default, and twice as many to measure the "
            "error",
            o.elements, 2, 4096),
      count("--presses", "presses held out to measure the error, 10 to 100000; 500 by default", o.presses, 10,
            100000),
      count("--threads", "1 to 256; by default as many as the machine runs at once", o.threads, 1, 256),
      file("--output", "where the model goes; beam.json by default", o.output),
      file("--plot", "a picture of singular values and errors, by gnuplot: NAME.svg or NAME.png", o.plot),
      {"--help", "", "prints this", [](const std::string&) {}},
  };
  list.insert(list.end(), own.begin(), own.end());
  return list;
}

void exclude_each_other(const std::vector<std::string>& given) {
  for (const char* option : {"--from", "--to", "--positions"})
    cli::exclude(given, option, "--at", "which is a single place");
  const char* one_way = "which says already how many modes there are";
  cli::exclude(given, "--error", "--modes", one_way);
  cli::exclude(given, "--energy", "--modes", one_way);
  cli::exclude(given, "--energy", "--error", one_way);
}

void check_position(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  cli::refuse(option, cli::digits(value), cli::digits(low) + " to " + cli::digits(high) + " m");
}

/// Defaults that depend on the beam, and limits that do.
void settle(Options& o, bool single_place) {
  const hapbeam::Beam beam = o.beam.make();
  const double L = beam.length();
  if (std::isnan(o.depth)) o.depth = L / 50;
  // A support is rigid: beside it there is no press.
  const double low = fixes_w(beam.left()) ? L / 1000 : 0, high = fixes_w(beam.right()) ? L - L / 1000 : L;
  // Rounded to float, a position on a limit must still be within.
  const double slack = o.scalar == Scalar::single_precision ? 1e-6 * L : 0;
  const auto inward = [=](double s) {
    return std::clamp(s, low > 0 ? low + slack : low, high < L ? high - slack : high);
  };
  if (single_place) {
    check_position("--at", o.from, low, high);
    o.from = o.to = inward(o.from);
    o.positions = 1;
    return;
  }
  const hapbeam::TrainingPlan anywhere = hapbeam::TrainingPlan::anywhere(beam, o.depth);
  if (std::isnan(o.from)) o.from = anywhere.s_min;
  if (std::isnan(o.to)) o.to = anywhere.s_max;
  check_position("--from", o.from, low, high);
  check_position("--to", o.to, low, high);
  o.from = inward(o.from), o.to = inward(o.to);
  if (o.from >= o.to)
    cli::refuse("--from", cli::digits(o.from),
                "less than --to, " + cli::digits(o.to) + " m; --at M trains one place");
}

}  // namespace

const char* name(Kind kind) { return kind == Kind::pod ? "pod" : "galerkin"; }
const char* name(Scalar scalar) { return scalar == Scalar::double_precision ? "double" : "float"; }

hapbeam::TrainingPlan Options::plan() const {
  hapbeam::TrainingPlan plan{from, to, positions, depth, depths};
  plan.segments = segments;
  return plan;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  options.from = options.to = options.depth = unset;
  const std::vector<std::string> given = cli::read(arguments, entries(options));
  exclude_each_other(given);
  if (options.segments % 2 != 0)
    cli::refuse("--segments", std::to_string(options.segments), "an even number, 2 to 1024");
  if (!options.plot.empty() && !ends_with(options.plot, ".svg") && !ends_with(options.plot, ".png"))
    cli::refuse("--plot", options.plot, "a name that ends in .svg or .png");
  settle(options, cli::contains(given, "--at"));
  return options;
}

std::string help() {
  Options unused;
  return "train: presses a beam by finite elements and makes a model of it that answers in a servo tick\n\n" +
         cli::describe(entries(unused)) +
         "\nphantom --model FILE presses what comes out.  Exit status: 0, 1 where the beam cannot be trained "
         "so or a "
         "file cannot be written, 2 for a wrong option.\n";
}

}  // namespace train
