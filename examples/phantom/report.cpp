#include "report.hpp"

#include <cstdio>
#include <limits>

#include "json.hpp"

namespace phantom {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

unsigned long long number(std::uint64_t count) { return count; }

void print_trained(const Options& o, const Trained& t) {
  const hapbeam::ErrorSummary& errors = t.errors.all;
  std::printf("beam     %s: %g m, %g mm thick, EA = %.4g N, EI = %.4g Nm2, %s\n", o.beam.name.c_str(),
              t.beam.length, t.beam.thickness * 1e3, t.beam.axial_stiffness, t.beam.bending_stiffness,
              cli::ends(t.beam.left, t.beam.right).c_str());
  std::printf("model    %s, %d x %d presses, %d modes, trained ", t.kind, t.positions, t.columns, t.modes);
  if (t.s_min == t.s_max) std::printf("at %.1f mm", t.s_min * 1e3);
  else std::printf("from %.1f to %.1f mm", t.s_min * 1e3, t.s_max * 1e3);
  std::printf(", up to %g mm deep\n", t.depth * 1e3);
  if (errors.presses > 0)
    std::printf("error    force within %.1e (95 %%: %.1e), shape within %.1e of %s, on %d presses\n",
                errors.force_max, errors.force_p95, errors.shape_max, t.errors.reference.c_str(),
                errors.presses);
  else std::printf("error    none is stated in the file\n");
  if (o.guarded)
    std::printf("guard    finite elements, %s, %d elements, beyond that range\n", name(o.element),
                o.elements);
}

}  // namespace

void print_scene(const Options& o, const Trained* trained, const hapbeam::DeviceInfo& device) {
  std::printf("device   %s, %.0f Hz, %s\n", device.name.c_str(), 1 / device.period,
              o.lock_step ? "lock step with simulated time" : "real time");
  if (trained) {
    print_trained(o, *trained);
  } else {
    std::printf("beam     %s\n", cli::describe(o.beam).c_str());
    std::printf("model    finite elements, %s, %d elements\n", name(o.element), o.elements);
  }
  std::printf("hand     %s, at %g m, aims %g mm below the surface, %g s; avatar of radius %g mm\n",
              name(o.script), o.place, o.depth * 1e3, o.duration, o.radius * 1e3);
  std::printf("scale    %g m of the scene for 1 m of the device; forces 1 : 1\n", o.scale);
  if (o.script == Script::slide)
    std::printf("slide    %.4g m to either side in the scene, within the beam and the device's %g mm\n",
                reach(o) * o.scale, device.workspace.x() * 1e3);
  std::printf("\n%7s %9s %9s %9s %9s %8s %7s %7s %9s  %s\n", "time s", "hand x mm", "hand y mm", "press mm",
              "force N", "ticks", "missed", "cut", "p99 us", "status");
}

void print_row(const Notes& n, const hapbeam::DeviceCounts& counts) {
  std::printf("%7.2f %9.2f %9.2f %9.3f %9.2f %8llu %7llu %7llu %9.1f  %s\n", n.time.load(), n.x.load() * 1e3,
              n.y.load() * 1e3, n.press.load() * 1e3, n.force.load(), number(counts.ticks),
              number(counts.missed_ticks), number(counts.force_cut_ticks), n.times.quantile(0.99),
              name(n.worst.load()));
  std::fflush(stdout);
}

void print_summary(const Run& run) {
  const Notes& n = run.notes;
  const hapbeam::DeviceCounts& c = run.counts;
  const double all = static_cast<double>(c.ticks > 0 ? c.ticks : 1);
  std::printf("\n%s%llu ticks, %llu missed (began more than one period after their deadline)\n",
              run.interrupted ? "interrupted after " : "", number(c.ticks), number(c.missed_ticks));
  std::printf("tick     p50 %.2f us, p99 %.2f us, max %.1f us: contact, press and force\n",
              n.times.quantile(0.5), n.times.quantile(0.99), n.times.longest());
  std::printf(
      "contact  in %llu ticks, begun %llu times; deepest press %.3f mm, largest force %.2f N; worst status "
      "%s\n",
      number(n.contact_ticks.load()), number(n.touches.load()), n.max_press.load() * 1e3, n.max_force.load(),
      name(n.worst.load()));
  if (run.options.guarded) {
    const std::uint64_t full = n.full_ticks.load(), contact = n.contact_ticks.load();
    std::printf("model    %s answered %llu of them, finite elements %llu\n", run.trained->kind,
                number(contact - full), number(full));
  }
  if (c.force_cut_ticks == 0) {
    std::printf("force    never cut: the device gives up to %g N\n", run.device.peak_force);
  } else {
    std::printf(
        "force    CUT in %llu ticks (%.1f %%): the beam asked for up to %.1f N and the device gives %g N.\n"
        "         There the hand did not feel the beam but the limit of the device.\n",
        number(c.force_cut_ticks), 100 * static_cast<double>(c.force_cut_ticks) / all, n.max_force.load(),
        run.device.peak_force);
  }
  // A script touches the beam once or twice; a few more are the hand's tremor at first touch.
  if (n.touches.load() > 20)
    std::printf(
        "bounce   contact began %llu times: the arm buzzes, because the beam is stiffer than a loop at %.0f "
        "Hz\n"
        "         with this arm's damping and friction can hold.\n",
        number(n.touches.load()), 1 / run.device.period);
  if (n.worst.load() != hapbeam::Status::out_of_range) return;
  if (run.trained && !run.options.guarded)
    std::printf(
        "range    some presses were out of the trained range and answered by what is nearest to them in it.\n"
        "         With --guarded finite elements answer there.\n");
  else
    std::printf(
        "range    some presses were out of range, too deep or too near to a support, and answered by the "
        "nearest\n"
        "         press in range.  A support is rigid: next to it forces grow without bound.\n");
}

std::string json(const Run& run) {
  const Options& o = run.options;
  const Notes& n = run.notes;
  JsonObject report;
  report.add("device", run.device.name)
      .add("peak_force_N", run.device.peak_force)
      .add("period_s", run.device.period)
      .add("real_time", !o.lock_step)
      .add("beam", o.beam.name)
      .add("length_m", o.beam.length)
      .add("width_m", o.beam.width)
      .add("height_m", o.beam.height)
      .add("young_Pa", o.beam.young)
      .add("ends", cli::ends(o.beam.left, o.beam.right))
      .add("model", run.trained ? run.trained->kind : "fem");
  if (const Trained* t = run.trained) {
    const hapbeam::ErrorSummary& errors = t->errors.all;
    const bool stated = errors.presses > 0;
    report.add("trained_from_m", t->s_min)
        .add("trained_to_m", t->s_max)
        .add("trained_depth_m", t->depth)
        .add("modes", t->modes)
        .add("stated_presses", errors.presses)
        .add("stated_force_error_median", stated ? errors.force_median : unknown)
        .add("stated_force_error_p95", stated ? errors.force_p95 : unknown)
        .add("stated_force_error_max", stated ? errors.force_max : unknown)
        .add("stated_shape_error_max", stated ? errors.shape_max : unknown)
        .add("guarded", o.guarded);
  }
  if (!run.trained || o.guarded) report.add("element", name(o.element)).add("elements", o.elements);
  if (o.guarded) report.add("full_model_ticks", n.full_ticks.load());
  return report.add("script", name(o.script))
      .add("place_m", o.place)
      .add("depth_m", o.depth)
      .add("radius_m", o.radius)
      .add("scale", o.scale)
      .add("duration_s", o.duration)
      .add("interrupted", run.interrupted)
      .add("ticks", run.counts.ticks)
      .add("missed_ticks", run.counts.missed_ticks)
      .add("contact_ticks", n.contact_ticks.load())
      .add("touches", n.touches.load())
      .add("tick_us_p50", n.times.quantile(0.5))
      .add("tick_us_p99", n.times.quantile(0.99))
      .add("tick_us_max", n.times.longest())
      .add("max_press_mm", n.max_press.load() * 1e3)
      .add("max_force_N", n.max_force.load())
      .add("force_cut_ticks", run.counts.force_cut_ticks)
      .add("max_status", name(n.worst.load()))
      .text();
}

}  // namespace phantom
