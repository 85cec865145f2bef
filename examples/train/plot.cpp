#include "plot.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>

#include <hapbeam/rom/file/replaced_file.hpp>

namespace train {

namespace {

/// As a string in single quotes, for gnuplot.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

/// A logarithmic axis has no place for zero.
double visible(double error) { return std::max(error, 1e-17); }

void data(std::ostream& script, const Result& r) {
  script << "$sigma << EOD\n";
  for (std::size_t i = 0; i < r.singular_values.size(); ++i)
    script << i + 1 << ' ' << visible(r.singular_values[i] / r.singular_values[0]) << '\n';
  script << "EOD\n$errors << EOD\n";
  for (const hapbeam::PressError& e : r.presses)
    script << e.depth * 1e3 << ' ' << visible(e.force) << ' ' << e.s * 1e3 << '\n';
  script << "EOD\n";
}

/// 1.2·10^{-6}, as gnuplot sets it.
std::string power_of_ten(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", x);
  const std::string number(text);
  const std::size_t e = number.find('e');
  return number.substr(0, e) + "·10^{" + std::to_string(std::atoi(number.c_str() + e + 1)) + "}";
}

void decay_panel(std::ostream& script, const Result& r) {
  const int all = static_cast<int>(r.singular_values.size()),
            shown = std::min(all, std::max(2 * r.modes, 12));
  const double lowest =
      visible(r.singular_values[static_cast<std::size_t>(shown - 1)] / r.singular_values[0]);
  script << "set title 'Modes of the shape: " << r.modes << " of " << all << " are kept'\n"
         << "set xlabel 'mode i'\nset ylabel 'singular value σ_i / σ_1'\n"
         << "set xrange [0:" << shown << ".7]\nset yrange [" << lowest / 3 << ":5]\n"
         << "plot $sigma using 1:($1 <= " << r.modes
         << " ? $2 : 1/0) with impulses lw 5 lc rgb '#2b6ca3' title 'kept', "
         << "$sigma using 1:($1 > " << r.modes
         << " ? $2 : 1/0) with points pt 7 ps dot lc rgb '#a0a0a0' title 'left out'\n";
}

void error_panel(std::ostream& script, const Options& o, const Result& r) {
  const hapbeam::ErrorSummary& e = r.errors.all;
  const double highest = visible(e.force_max), line = visible(e.force_p95);
  script << "set title 'Force: wrong by at most " << power_of_ten(highest) << ", on " << e.presses
         << " presses it has not seen'\n"
         << "set xlabel 'depth of the press [mm]'\nset ylabel 'relative error of the force'\n"
         << "set xrange [0:" << o.depth * 1e3 << "]\n"
         << "set yrange [" << highest / 1e5 << ":" << highest * 10 << "]\n";
  if (!o.single_place())
    script << "set cbrange [" << o.from * 1e3 << ":" << o.to * 1e3 << "]\n"
           << "set cblabel 'position along the beam [mm]'\n";
  script << "plot $errors using 1:2" << (o.single_place() ? "" : ":3") << " with points pt 7 ps dot lc "
         << (o.single_place() ? "rgb '#2b6ca3'" : "palette") << " title 'a press', " << line
         << " with lines lw 2 dt 2 lc rgb '#c0392b' title '95 % are below " << power_of_ten(line) << "'\n";
}

std::string script_of(const Options& o, const Result& r, const std::string& file) {
  const bool svg = o.plot.compare(o.plot.size() - 4, 4, ".svg") == 0;
  std::ostringstream script;
  data(script, r);
  // One counts a font in pixels, the other in points.
  script << "set terminal "
         << (svg ? "svg enhanced font 'Helvetica,15'" : "pngcairo enhanced font 'Helvetica,11.5'")
         << " size 1280,560 background rgb 'white'\n"
         << "dot = " << (svg ? 0.6 : 0.9) << "\n"
         << "set encoding utf8\nset output " << quoted(file) << "\n"
         << "set multiplot layout 1,2 title 'A beam of " << o.beam.length << " m, "
         << cli::ends(o.beam.left, o.beam.right) << ", pressed up to " << o.depth * 1e3
         << " mm deep: " << name(o.kind) << " model in " << name(o.scalar) << "'\n"
         << "set logscale y\nset format y '10^{%T}'\nset grid ytics lc rgb '#e0e0e0'\nset border 3\n"
         << "set tics nomirror\nset mytics 1\nset key top right\n"
         << "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n";
  decay_panel(script, r);
  error_panel(script, o, r);
  script << "unset multiplot\nset output\n";
  return script.str();
}

}  // namespace

void plot(const Options& options, const Result& result) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0)
    throw std::runtime_error(options.plot +
                             ": gnuplot is needed to draw it and cannot be run; the model was written");
  std::signal(SIGPIPE, SIG_IGN);
  try {
    hapbeam::detail::ReplacedFile file(options.plot);  // a picture is whole or not there
    std::FILE* gnuplot = popen("gnuplot 2>/dev/null", "w");
    bool drawn = gnuplot && std::fputs(script_of(options, result, file.temporary()).c_str(), gnuplot) >= 0;
    drawn = gnuplot && pclose(gnuplot) == 0 && drawn;
    if (!drawn) throw std::runtime_error(options.plot + ": gnuplot could not draw it");
    file.replace();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; the model was written");
  }
  std::printf("plot     %s\n", options.plot.c_str());
}

}  // namespace train
