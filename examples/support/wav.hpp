// Sound in a file that anything plays: RIFF, mono, 16 bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

/// As loud as 16 bits can be, whatever the unit of the samples.   @param rate [Hz]   @return whether all was written
inline bool write_wav(const std::string& path, const std::vector<float>& samples, int rate) {
  float loudest = 1e-30F;
  for (const float x : samples) loudest = std::max(loudest, std::abs(x));
  std::vector<std::int16_t> values;
  for (const float x : samples) values.push_back(static_cast<std::int16_t>(32000 * x / loudest));
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (!file) return false;
  const auto bytes = static_cast<std::uint32_t>(2 * values.size()), hertz = static_cast<std::uint32_t>(rate);
  const std::uint32_t head[] = {0x46464952, 36 + bytes, 0x45564157, 0x20746d66, 16,   0x00010001,
                                hertz,      2 * hertz,  0x00100002, 0x61746164, bytes};
  const bool written = std::fwrite(head, sizeof head, 1, file) == 1 &&
                       std::fwrite(values.data(), 2, values.size(), file) == values.size();
  return std::fclose(file) == 0 && written;
}
