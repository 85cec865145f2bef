#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "scene.hpp"
#ifdef HAPBEAM_EXAMPLES_MODEL_FILE
#include <hapbeam/rom/file/json.hpp>
#endif

namespace phantom {

namespace {

unsigned long long number(std::uint64_t count) { return count; }

/// Of the model; where it had no answer, in how many ticks.
std::string worst(const hapbeam::ServoRecord& r) {
  const std::string status = name(r.worst);
  return is_answer(r.worst) ? status
                            : status + " (" + std::to_string(r.continued_ticks + r.failed_ticks) + " ticks)";
}

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
                t.errors.force_bound, errors.force_p95, errors.shape_max, t.errors.reference.c_str(),
                errors.presses);
  else std::printf("error    none is stated in the file\n");
  if (o.guarded)
    std::printf("guard    finite elements, %s, %d elements, beyond that range\n", name(o.element),
                o.elements);
}

}  // namespace

Run Run::of(Session& session, bool interrupted, const hapbeam::TimeSummary& pictures) {
  session.update();
  const Body& body = session.body();
  const Session::Picture picture = session.picture();
  return {body.options(),
          body.trained(),
          session.device().info(),
          picture.record,
          picture.second ? std::optional(*picture.second) : std::nullopt,
          body.times(),
          body.deepest(),
          body.peak(),
          body.dissipated(),
          session.device().counts(),
          body.full_answers(),
          session.device().priority(),
          interrupted,
          pictures};
}

void print_scene(const Options& o, const Trained* trained, const hapbeam::DeviceInfo& device) {
  std::printf("device   %s, %.0f Hz, %s\n", device.name.c_str(), 1 / device.period,
              o.lock_step ? "lock step with simulated time" : "real time");
  if (trained) {
    print_trained(o, *trained);
  } else {
    std::printf("beam     %s\n", cli::describe(o.beam).c_str());
    if (o.beams > 1) std::printf("beams    %d, each %g mm below the one before\n", o.beams, o.pitch * 1e3);
    if (!o.feels.empty()) std::printf("feels    %s\n", o.feels.c_str());
    std::printf("model    finite elements, %s, %d elements\n", name(o.element), o.elements);
  }
  if (holds_end(o.avatar))
    std::printf("hand     %s, holds the left end, by %g mm, %g s\n", name(o.script), o.depth * 1e3,
                o.duration);
  else
    std::printf("hand     %s, at %g m, aims %g mm below the surface, %g s; %s of radius %g mm\n",
                o.script == Script::around ? "around: from above, the front and below" : name(o.script),
                o.place, o.depth * 1e3, o.duration, o.avatar == Avatar::needle ? "a needle" : "avatar",
                o.radius * 1e3);
  if (o.hands == 2)
    std::printf("second   a simulated Phantom holds it from below, at %g m\n", second_place(o));
  if (o.friction > 0) std::printf("friction coefficient %g between avatar and beam\n", o.friction);
  std::printf("scale    %g m of the scene for 1 m of the device; forces 1 : 1\n", o.scale);
  if (o.coupling == CouplingChoice::direct)
    std::printf("coupling direct: the hand presses the beam itself\n");
  else
    std::printf("coupling virtual: %.4g N/m, %.3g Ns/m between hand and beam; at rest they are in series\n",
                o.stiffness, o.damping);
  if (o.script == Script::slide)
    std::printf("slide    %.4g m to either side in the scene, within the beam and the device's %g mm\n",
                reach(o) * o.scale, device.workspace.x() * 1e3);
  std::printf("\n%7s %9s %9s %s%9s %9s %8s %7s %7s %10s  %s\n", "time s", "hand x mm", "hand y mm",
              o.beam.in_space() ? "hand z mm " : "", "press mm", "force N", "ticks", "missed", "cut",
              "p99 µs", "status");
}

void print_row(Session& session) {
  const hapbeam::ServoRecord& r = session.picture().record;
  const Device& device = session.device();
  const Body& body = session.body();
  const hapbeam::DeviceCounts counts = device.counts();
  const bool in_space = body.options().beam.in_space();
  std::printf("%7.2f %9.2f %9.2f ", r.time, r.position.x() * 1e3, r.position.y() * 1e3);
  if (in_space) std::printf("%9.2f ", r.position.z() * 1e3);
  std::printf("%9.3f %9.2f %8llu %7llu %7llu %9.1f  %s\n", 1e3 * (in_space ? body.depth(r) : r.press.d),
              r.force.norm(), number(counts.ticks), number(counts.missed_ticks), number(r.saturated_ticks),
              body.times().compute().quantile(0.99) * 1e6,
              asks(device) ? name(r.status) : name(device.status()));
  std::fflush(stdout);
}

void print_summary(const Run& run) {
  const hapbeam::ServoRecord& r = run.record;
  const hapbeam::DeviceCounts& c = run.counts;
  const hapbeam::TimeSummary compute = run.times.compute().summary();
  const double all = static_cast<double>(c.ticks > 0 ? c.ticks : 1);
  std::printf("\n%s%llu ticks, %llu missed (began more than one period after their deadline)\n",
              run.interrupted ? "interrupted after " : "", number(c.ticks), number(c.missed_ticks));
  if (!run.options.lock_step && run.priority != hapbeam::RealTime::done)
    std::printf("time     %s\n", message(run.priority));
  std::printf("tick     p50 %.2f µs, p99 %.2f µs, max %.1f µs: contact, press and force\n", compute.p50 * 1e6,
              compute.p99 * 1e6, compute.max * 1e6);
  std::printf(
      "contact  in %llu ticks, begun %llu times; deepest press %.3f mm, largest force %.2f N; worst status "
      "%s\n",
      number(r.contact_ticks), number(r.touches), run.deepest * 1e3, r.max_force, worst(r).c_str());
  if (run.second)
    std::printf(
        "second   in %llu ticks, begun %llu times; largest force %.2f N, cut in %llu ticks; worst status "
        "%s\n",
        number(run.second->contact_ticks), number(run.second->touches), run.second->max_force,
        number(run.second->saturated_ticks), worst(*run.second).c_str());
  if (run.peak.strain > 0)
    std::printf("strain   %.2g %% at the surface where it was largest, at %.1f mm: %.3g MPa\n",
                100 * run.peak.strain, run.peak.s * 1e3, run.peak.strain * run.options.beam.young * 1e-6);
  if (run.options.friction > 0) std::printf("friction took %.2g J\n", run.dissipated);
  if (run.options.guarded)
    std::printf("model    %s answered %llu of them, finite elements %llu\n", run.trained->kind,
                number(r.contact_ticks - std::min(run.full_answers, r.contact_ticks)),
                number(run.full_answers));
  if (r.saturated_ticks == 0) {
    std::printf("force    never cut: the device gives up to %g N, and %g N for as long as one likes\n",
                run.device.peak_force, run.device.continuous_force);
  } else {
    std::printf(
        "force    CUT in %llu ticks (%.1f %%): the device gives %g N, or %g N once its motors are warm.\n"
        "         There the hand did not feel the beam but the limit of the device.\n",
        number(r.saturated_ticks), 100 * static_cast<double>(r.saturated_ticks) / all, run.device.peak_force,
        run.device.continuous_force);
  }
  if (run.second)
    std::printf(
        "energy   %.2g J received by the first hand and %.2g J by the second, which the other one may have "
        "given\n",
        r.energy_generated, run.second->energy_generated);
  else std::printf("energy   %.2g J generated by the loop beyond what the arm took\n", r.energy_generated);
  // A script touches the beam once or twice; a few more are the hand's tremor at first touch.
  if (r.touches > 20)
    std::printf(
        "bounce   contact began %llu times: the arm buzzes, because the beam is stiffer than a loop at %.0f "
        "Hz\n"
        "         with this arm's damping and friction can hold.%s\n",
        number(r.touches), 1 / run.device.period,
        run.options.coupling == CouplingChoice::direct ? "  --coupling virtual holds it." : "");
  if (r.worst != hapbeam::Status::out_of_range) return;
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

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE

namespace {

/// Of the members of a report, whose units are in their names.
class Report {
 public:
  void add(const char* name, const std::string& value) { writer_.word(name, value); }
  void add(const char* name, const char* value) { writer_.word(name, value); }
  void add(const char* name, bool value) { writer_.flag(name, value); }
  void add(const char* name, int value) { writer_.count(name, value); }
  void add(const char* name, std::uint64_t value) { writer_.count(name, static_cast<long long>(value)); }
  /// What is not known is not there.
  void add(const char* name, double value) {
    if (std::isfinite(value)) writer_.real(name, "", value);
  }
  std::string text() const { return writer_.text(9, hapbeam::detail::JsonWriter::Layout::indented) + "\n"; }

 private:
  const std::string source_ = "report";
  hapbeam::detail::JsonWriter writer_{source_};
};

void add_trained(Report& report, const Trained& t) {
  const hapbeam::ErrorSummary& errors = t.errors.all;
  report.add("trained_from_m", t.s_min);
  report.add("trained_to_m", t.s_max);
  report.add("trained_depth_m", t.depth);
  report.add("modes", t.modes);
  report.add("stated_presses", errors.presses);
  if (errors.presses == 0) return;
  report.add("stated_force_error_median", errors.force_median);
  report.add("stated_force_error_p95", errors.force_p95);
  report.add("stated_force_error_max", t.errors.force_bound);
  report.add("stated_shape_error_max", errors.shape_max);
}

}  // namespace

std::string json(const Run& run) {
  const Options& o = run.options;
  const hapbeam::ServoRecord& r = run.record;
  const hapbeam::TimeSummary compute = run.times.compute().summary();
  // Simulated time keeps its period.
  const double period_p99 = o.lock_step ? run.device.period : run.times.period().quantile(0.99);
  Report report;
  report.add("device", run.device.name);
  report.add("peak_force_N", run.device.peak_force);
  report.add("period_s", run.device.period);
  report.add("real_time", !o.lock_step);
  report.add("priority", run.priority == hapbeam::RealTime::done);
  report.add("scene", o.scene);
  report.add("beam", o.beam.name);
  report.add("length_m", o.beam.length);
  report.add("width_m", o.beam.width);
  report.add("height_m", o.beam.height);
  report.add("rise_m", o.beam.rise);
  report.add("tension_N", o.beam.tension);
  report.add("young_Pa", o.beam.young);
  report.add("ends", cli::ends(o.beam.left, o.beam.right));
  report.add("model", run.trained ? run.trained->kind : "fem");
  if (run.trained) {
    add_trained(report, *run.trained);
    report.add("guarded", o.guarded);
  }
  if (!run.trained || o.guarded) {
    report.add("element", name(o.element));
    report.add("elements", o.elements);
  }
  if (o.guarded) report.add("full_model_ticks", run.full_answers);
  if (run.pictures.count > 0) {
    report.add("pictures", run.pictures.count);
    report.add("picture_ms_p50", run.pictures.p50 * 1e3);
    report.add("picture_ms_p99", run.pictures.p99 * 1e3);
    report.add("picture_ms_max", run.pictures.max * 1e3);
  }
  report.add("hands", o.hands);
  if (run.second) {
    report.add("second_place_m", second_place(o));
    report.add("second_contact_ticks", run.second->contact_ticks);
    report.add("second_touches", run.second->touches);
    report.add("second_max_force_N", run.second->max_force);
    report.add("second_force_saturated_ticks", run.second->saturated_ticks);
    report.add("second_energy_generated_J", run.second->energy_generated);
    report.add("second_max_status", name(run.second->worst));
  }
  report.add("script", name(o.script));
  report.add("place_m", o.place);
  report.add("depth_m", o.depth);
  report.add("avatar", name(o.avatar));
  report.add("radius_m", o.radius);
  report.add("friction", o.friction);
  report.add("scale", o.scale);
  report.add("duration_s", o.duration);
  report.add("interrupted", run.interrupted);
  report.add("ticks", run.counts.ticks);
  report.add("missed_ticks", run.counts.missed_ticks);
  report.add("contact_ticks", r.contact_ticks);
  report.add("touches", r.touches);
  report.add("coupling", name(o.coupling));
  report.add("stiffness_N_per_m", o.stiffness);
  report.add("damping_Ns_per_m", o.damping);
  report.add("tick_us_p50", compute.p50 * 1e6);
  report.add("tick_us_p99", compute.p99 * 1e6);
  report.add("tick_us_max", compute.max * 1e6);
  report.add("period_us_p99", period_p99 * 1e6);
  report.add("deadline_misses", o.lock_step ? run.counts.missed_ticks : run.times.missed());
  report.add("max_press_mm", run.deepest * 1e3);
  report.add("max_strain", run.peak.strain);
  report.add("max_force_N", r.max_force);
  report.add("force_cut_ticks", run.counts.force_cut_ticks);
  report.add("force_saturated_ticks", r.saturated_ticks);
  report.add("friction_J", run.dissipated);
  report.add("energy_generated_J", r.energy_generated);
  report.add("max_status", name(r.worst));
  return report.text();
}

#else

std::string json(const Run&) { return {}; }

#endif

ReportFile::ReportFile(const std::string& path) : path_(path) {
#ifndef HAPBEAM_EXAMPLES_MODEL_FILE
  if (!path.empty())
    throw cli::UsageError(
        "--report: cannot be used, this program was built without jansson, which writes it");
#endif
  if (!path.empty()) file_.open(path);
  if (!file_) throw std::runtime_error(path + ": the report cannot be written");
}

bool ReportFile::write(const std::string& text) {
  if (path_.empty() || file_ << text << std::flush) return true;
  std::fprintf(stderr, "phantom: %s: the report cannot be written\n", path_.c_str());
  return false;
}

}  // namespace phantom
