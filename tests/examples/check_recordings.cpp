// What recordings of phantom must fulfil.
//
//   check_recordings slew FILE RATE [N/s]            the force never changes faster, up or down; a beam that is said to snap may
//                                                    let go at once
//   check_recordings beside FILE DISTANCE [m]       the beam is felt where the hand is so far from the line of a script that
//                                                    presses straight down
//   check_recordings sides FILE                     the hand is pushed up by half a newton, and toward who looks, at different times
//   check_recordings friction FILE                  a touch sticks and slides, and friction never gives back what it took in it
//   check_recordings same FILE FILE TOLERANCE [N]    the same forces at the same times, in contact a tenth of a second at least
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace {

struct Row {
  double time, hand_x, x, y, z;  ///< [s, m, N, N, N]
  double rubs, dissipated;       ///< [N, J]
  int slides;
  bool snapped;
};

std::vector<Row> read(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    Row row{};
    double fx, fy, fz;
    char model[32];
    if (std::sscanf(
            line.c_str(),
            "%lf,%lf,%*f,%*f,%*f,%*f,%*f,%*f,%*f,%*f,%lf,%lf,%lf,%*f,%*f,%lf,%lf,%lf,%d,%lf,%*[^,],%31s",
            &row.time, &row.hand_x, &row.x, &row.y, &row.z, &fx, &fy, &fz, &row.slides, &row.dissipated,
            model) != 11) {
      std::fprintf(stderr, "%s: is no recording\n", path);
      std::exit(2);
    }
    row.rubs = std::hypot(fx, fy, fz);
    row.snapped = std::strcmp(model, "snapped") == 0;
    rows.push_back(row);
  }
  return rows;
}

/// Of the force [N].  A snap, which lets go at once, is measured from the nearest of the forces from the last one to none.
double change(const Row& from, const Row& to) {
  const double square = from.x * from.x + from.y * from.y + from.z * from.z;
  const double along = to.x * from.x + to.y * from.y + to.z * from.z;
  const double left = to.snapped && square > 0 ? std::min(std::max(along / square, 0.0), 1.0) : 1;
  return std::hypot(to.x - left * from.x, to.y - left * from.y, to.z - left * from.z);
}

int slew(const char* path, double rate) {
  const std::vector<Row> rows = read(path);
  double most = 0, at = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double speed = change(rows[i - 1], rows[i]) / (rows[i].time - rows[i - 1].time);
    if (speed > most) most = speed, at = rows[i].time;
  }
  std::printf("%zu ticks, the force changes by %.6g N/s at most, at %.3f s\n", rows.size(), most, at);
  // A force that never changed proves nothing.  Differences of times are good to 1e-10.
  return most > 0.01 * rate && most <= rate * (1 + 1e-8) ? 0 : 1;
}

int beside(const char* path, double distance) {
  int ticks = 0;
  for (const Row& row : read(path))
    ticks += std::abs(row.hand_x) >= distance && std::hypot(row.x, row.y, row.z) > 0;
  std::printf("in contact beside the line in %d ticks\n", ticks);
  return ticks > 0 ? 0 : 1;
}

int sides(const char* path) {
  int up = 0, out = 0;
  for (const Row& row : read(path))
    up += row.y > 0.5 && row.y > 3 * row.z, out += row.z > 0.5 && row.z > 3 * row.y;
  std::printf("pushed up in %d ticks, toward who looks in %d\n", up, out);
  return up > 0 && out > 0 ? 0 : 1;
}

int friction(const char* path) {
  int sticks = 0, slides = 0, gives = 0;
  double before = 0, most = 0;
  for (const Row& row : read(path)) {
    const bool touches = row.rubs > 0;
    sticks += touches && !row.slides, slides += touches && row.slides;
    gives += touches && before > 0 && row.dissipated > 0 && row.dissipated < before;
    before = row.dissipated, most = std::max(most, before);
  }
  std::printf("sticks in %d ticks, slides in %d, took %.3g J in a touch\n", sticks, slides, most);
  return sticks > 0 && slides > 0 && most > 0 && gives == 0 ? 0 : 1;
}

int same(const char* path_a, const char* path_b, double tolerance) {
  const std::vector<Row> a = read(path_a), b = read(path_b);
  double most = 0, largest = 0;
  int pressed = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i].time != b[i].time) return std::printf("other times\n"), 1;
    const double force = std::hypot(a[i].x, a[i].y, a[i].z);
    most = std::max(most, std::hypot(a[i].x - b[i].x, a[i].y - b[i].y, a[i].z - b[i].z));
    largest = std::max(largest, force);
    pressed += force > 0;
  }
  std::printf("%zu and %zu ticks, %d of them in contact, up to %.3f N; they differ by %.3g N\n", a.size(),
              b.size(), pressed, largest, most);
  return a.size() == b.size() && pressed >= 100 && most <= tolerance ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "slew") == 0) return slew(argv[2], std::atof(argv[3]));
  if (argc == 4 && std::strcmp(argv[1], "beside") == 0) return beside(argv[2], std::atof(argv[3]));
  if (argc == 3 && std::strcmp(argv[1], "sides") == 0) return sides(argv[2]);
  if (argc == 3 && std::strcmp(argv[1], "friction") == 0) return friction(argv[2]);
  if (argc == 5 && std::strcmp(argv[1], "same") == 0) return same(argv[2], argv[3], std::atof(argv[4]));
  return 2;
}
