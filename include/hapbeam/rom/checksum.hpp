// CRC-32, as zlib, gzip and PNG compute it: reflected, polynomial 0xEDB88320.
//
// Finds every error of up to 32 bits in a row, and all but one of 4·10⁹ others.  No protection against intent.
// No allocation, noexcept.  Source: ISO 3309; the check value of "123456789" is 0xCBF43926.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hapbeam::detail {

struct Crc32Table {
  std::uint32_t entry[256];

  constexpr Crc32Table() : entry() {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t rest = byte;
      for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ (rest & 1 ? 0xEDB88320u : 0u);
      entry[byte] = rest;
    }
  }
};

inline constexpr Crc32Table crc32_table{};

inline std::uint32_t crc32(const char* bytes, std::size_t size) noexcept {
  std::uint32_t rest = 0xFFFFFFFFu;
  for (std::size_t k = 0; k < size; ++k)
    rest = (rest >> 8) ^ crc32_table.entry[(rest ^ static_cast<unsigned char>(bytes[k])) & 0xFFu];
  return ~rest;
}

}  // namespace hapbeam::detail
