#include "recording.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <stdexcept>

namespace phantom {

namespace {

constexpr const char* head =
    "time_s,hand_x_m,hand_y_m,hand_z_m,hand_vx_m_per_s,hand_vy_m_per_s,hand_vz_m_per_s,";
constexpr const char* felt =
    "x_m,y_m,z_m,force_x_N,force_y_N,force_z_N,place_m,depth_m,friction_x_N,friction_y_N,friction_z_N,slides,"
    "dissipated_J,status,model";
constexpr double longest = 86400;  // [s]

/// A line of numbers with a comma behind each, in digits that read back the same: the shortest where the standard library finds them.
class Line {
 public:
  void add(std::initializer_list<double> values) {
    for (const double value : values) {
#ifdef __cpp_lib_to_chars
      end_ = std::to_chars(end_, text_ + sizeof text_, value).ptr;
      *end_++ = ',';
#else
      end_ += std::snprintf(end_, static_cast<std::size_t>(text_ + sizeof text_ - end_), "%.17g,", value);
#endif
    }
  }
  void write(std::FILE* file) const { std::fwrite(text_, 1, static_cast<std::size_t>(end_ - text_), file); }

 private:
  char text_[20 * 25];  // a number takes 24 characters at most
  char* end_ = text_;
};

}  // namespace

Recording::Recording(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_ || std::fprintf(file_.get(), "%s%s\n", head, felt) < 0)
    throw std::runtime_error(path + ": the recording cannot be written");
}

void Recording::write(const Tick& tick) {
  const hapbeam::ServoRecord& r = tick.record;
  Line line;
  line.add({r.time});
  for (const Eigen::Vector3d& v : {tick.hand.position, tick.hand.velocity, r.position, r.force})
    line.add({v.x(), v.y(), v.z()});
  line.add({r.press.s, r.press.d, r.friction.x(), r.friction.y(), r.friction.z(), double(r.sliding),
            r.dissipated});
  line.write(file_.get());
  std::fprintf(file_.get(), "%s,%s\n", name(r.status), name(r.model));
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
