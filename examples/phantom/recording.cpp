#include "recording.hpp"

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace phantom {

namespace {

constexpr const char* head =
    "time_s,hand_x_m,hand_y_m,hand_z_m,hand_vx_m_per_s,hand_vy_m_per_s,hand_vz_m_per_s,";
constexpr const char* felt =
    "x_m,y_m,z_m,force_x_N,force_y_N,force_z_N,place_m,depth_m,friction_x_N,friction_y_N,friction_z_N,slides,"
    "dissipated_J,status,model";
constexpr double longest = 86400;  // [s]

}  // namespace

Recording::Recording(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_ || std::fprintf(file_.get(), "%s%s\n", head, felt) < 0)
    throw std::runtime_error(path + ": the recording cannot be written");
}

void Recording::write(const Tick& tick) {
  const hapbeam::ServoRecord& r = tick.record;
  std::fprintf(file_.get(), "%.17g,", r.time);
  for (const Eigen::Vector3d& v : {tick.hand.position, tick.hand.velocity, r.position, r.force})
    std::fprintf(file_.get(), "%.17g,%.17g,%.17g,", v.x(), v.y(), v.z());
  std::fprintf(file_.get(), "%.17g,%.17g,%.17g,%.17g,%.17g,%d,%.17g,%s,%s\n", r.press.s, r.press.d,
               r.friction.x(), r.friction.y(), r.friction.z(), int(r.sliding), r.dissipated, name(r.status),
               name(r.model));
}

void Recording::close() {
  const bool whole = file_ && !std::ferror(file_.get());
  if (std::FILE* file = file_.release(); !file || std::fclose(file) != 0 || !whole)
    throw std::runtime_error(path_ + ": the recording cannot be written");
}

Replay read_recording(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  std::string line;
  if (!std::getline(file, line) || line.rfind(head, 0) != 0)
    throw std::runtime_error(path + ": is no recording, its first line must begin with " + head);
  Replay replay;
  for (int number = 2; std::getline(file, line); ++number) {
    double time;
    Eigen::Vector3d x, v;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &time, &x[0], &x[1], &x[2], &v[0], &v[1],
                    &v[2]) != 7 ||
        !(time >= 0 && time < longest) || !(x.array().abs() < 1).all() || !(v.array().abs() < 100).all())
      throw std::runtime_error(path + ", line " + std::to_string(number) +
                               ": must begin with time [s], place [m] and velocity [m/s] of a hand");
    const hapbeam::HandTarget target{x, v};
    const auto tick = static_cast<std::size_t>(std::llround(time / Replay::period));
    if (tick < replay.targets.size())
      throw std::runtime_error(path + ", line " + std::to_string(number) +
                               ": the time must be after the one before it");
    replay.targets.resize(tick, replay.targets.empty() ? target : replay.targets.back());
    replay.targets.push_back(target);
  }
  if (replay.targets.empty()) throw std::runtime_error(path + ": has no ticks");
  return replay;
}

}  // namespace phantom
