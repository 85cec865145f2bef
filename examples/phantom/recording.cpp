#include "recording.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
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

auto commas(const std::string& line) { return std::count(line.begin(), line.end(), ','); }

/// The columns of the hand, each a number and nothing else.   @return false where they are not, or not near a device
bool read_row(const std::string& line, double& time, hapbeam::HandTarget& target) {
  double values[7];
  const char* text = line.c_str();
  for (double& value : values) {
    char* end;
    value = std::strtod(text, &end);
    if (end == text || *end != ',') return false;
    text = end + 1;
  }
  time = values[0];
  target = {{values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
  return time >= 0 && time < longest && (target.position.array().abs() < 1).all() &&
         (target.velocity.array().abs() < 100).all();
}

}  // namespace

Recording::Recording(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_ || std::fprintf(file_.get(), "%s%s\n", head, felt) < 0)
    throw std::runtime_error(path + ": the recording cannot be written");
}

void Recording::write(const Tick& tick) {
  if (std::ferror(file_.get())) return;  // so that no row stands behind a part of one
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

bool Recording::close(std::uint64_t lost) {
  bool written = !std::ferror(file_.get());
  written &= std::fclose(file_.release()) == 0;
  if (!written)
    std::fprintf(stderr, "phantom: %s: the recording cannot be written, and is cut off\n", path_.c_str());
  if (lost > 0)
    std::fprintf(stderr, "phantom: %s: %llu ticks are missing, the disk was too slow\n", path_.c_str(),
                 static_cast<unsigned long long>(lost));
  return written;
}

Replay read_recording(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  std::string line;
  if (!std::getline(file, line) || line.rfind(head, 0) != 0)
    throw std::runtime_error(path + ": is no recording, its first line must begin with " + head);
  const auto columns = commas(line) + 1;
  Replay replay;
  for (int number = 2; std::getline(file, line); ++number) {
    const auto reject = [&](const std::string& why) {
      throw std::runtime_error(path + ", line " + std::to_string(number) + ": " + why);
    };
    if (file.eof()) reject("is cut off, it must end with a newline");
    if (commas(line) + 1 != columns)
      reject("has " + std::to_string(commas(line) + 1) + " columns, it must have the " +
             std::to_string(columns) + " of the first line");
    Replay::Row row;
    double time;
    if (!read_row(line, time, row.target))
      reject("must begin with time [s], place [m] and velocity [m/s] of a hand");
    row.tick = Replay::tick(time);
    if (!replay.rows.empty() && row.tick <= replay.rows.back().tick)
      reject("the time must be after the one before it");
    replay.rows.push_back(row);
  }
  if (file.bad()) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  if (replay.rows.empty()) throw std::runtime_error(path + ": has no ticks");
  return replay;
}

}  // namespace phantom
