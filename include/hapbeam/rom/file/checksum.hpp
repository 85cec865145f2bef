// CRC-32, as zlib, gzip and PNG compute it: reflected, polynomial 0xEDB88320.
//
// Finds every error of up to 32 bits in a row, and all but one of 4·10⁹ others.  No protection against intent.
// No allocation, noexcept.  Source: ISO 3309; the check value of "123456789" is 0xCBF43926.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hapbeam::detail {

/// Remainders of four bits. Those of eight would be twice as fast, but each file that loads a model would compile them.
inline constexpr std::uint32_t crc32_table[16] = {
    0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
    0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};

inline std::uint32_t crc32(const char* bytes, std::size_t size) noexcept {
  std::uint32_t rest = 0xFFFFFFFFu;
  for (std::size_t k = 0; k < size; ++k) {
    rest ^= static_cast<unsigned char>(bytes[k]);
    rest = (rest >> 4) ^ crc32_table[rest & 15];
    rest = (rest >> 4) ^ crc32_table[rest & 15];
  }
  return ~rest;
}

}  // namespace hapbeam::detail
