// Whether two pictures of the window look the same.
//
//   compare_pictures reduce PICTURE.png SMALL.png
//   compare_pictures same   PICTURE.png SMALL.png [X0,Y0,X1,Y1]...      parts of the picture (0 to 1) that do not count
//
// Pictures are reduced to 320 x 180 by averaging, which forgives another rasteriser its edges of text and lines.  They
// are the same where the grey values, 0 to 255, differ by 1 on average and by 24 on average over any square of 10 x 10:
// a moved beam or a missing line of text is more than that.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "support/stb.hpp"

namespace {

constexpr int width = 320, height = 180, square = 10;
constexpr double mean_limit = 1, local_limit = 24;

struct Picture {
  std::vector<double> values = std::vector<double>(width * height, 0.0);  ///< 0 to 255, row by row
  double& at(int x, int y) { return values[static_cast<std::size_t>(y * width + x)]; }
  double at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
};

/// @return whether there is one whose size is a multiple of the reduced one
bool read(const char* path, Picture& picture) {
  int w = 0, h = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(stbi_load(path, &w, &h, &channels, 1),
                                                         stbi_image_free);
  if (!pixels || w % width != 0 || h % height != 0 || w / width != h / height) {
    std::fprintf(stderr, "%s: must be a PNG of a multiple of %d x %d pixels\n", path, width, height);
    return false;
  }
  const int n = w / width;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      picture.at(x / n, y / n) += pixels.get()[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                               static_cast<std::size_t>(x)] /
                                  static_cast<double>(n * n);
  return true;
}

int reduce(const char* from, const char* to) {
  Picture picture;
  if (!read(from, picture)) return 2;
  std::vector<unsigned char> bytes;
  for (const double value : picture.values) bytes.push_back(static_cast<unsigned char>(std::lround(value)));
  return stbi_write_png(to, width, height, 1, bytes.data(), width) ? 0 : 2;
}

/// @param parts  so many that do not count
int same(const char* path_a, const char* path_b, char** parts, int count) {
  Picture a, b;
  if (!read(path_a, a) || !read(path_b, b)) return 2;
  for (int i = 0; i < count; ++i) {
    double x0, y0, x1, y1;
    if (std::sscanf(parts[i], "%lf,%lf,%lf,%lf", &x0, &y0, &x1, &y1) != 4) return 2;
    for (int y = static_cast<int>(y0 * height); y < std::min(height, static_cast<int>(y1 * height)); ++y)
      for (int x = static_cast<int>(x0 * width); x < std::min(width, static_cast<int>(x1 * width)); ++x)
        a.at(x, y) = b.at(x, y) = 0;
  }
  double sum = 0, most = 0;
  int most_x = 0, most_y = 0;
  for (int y = 0; y + square <= height; y += square / 2)
    for (int x = 0; x + square <= width; x += square / 2) {
      double local = 0;
      for (int i = 0; i < square * square; ++i) {
        const int px = x + i % square, py = y + i / square;
        local += std::abs(a.at(px, py) - b.at(px, py)) / (square * square);
      }
      if (local > most) most = local, most_x = x, most_y = y;
    }
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::abs(a.values[i] - b.values[i]) / static_cast<double>(a.values.size());
  const bool equal = sum <= mean_limit && most <= local_limit;
  std::printf("%s: differ by %.2f on average, by %.1f around (%d, %d) of %d x %d\n",
              equal ? "same" : "different", sum, most, most_x + square / 2, most_y + square / 2, width,
              height);
  return equal ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "reduce") == 0) return reduce(argv[2], argv[3]);
  if (argc >= 4 && std::strcmp(argv[1], "same") == 0) return same(argv[2], argv[3], argv + 4, argc - 4);
  return 2;
}
