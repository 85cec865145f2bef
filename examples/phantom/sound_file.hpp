// What is heard in a run, on file.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "body.hpp"
#include "support/wav.hpp"

namespace phantom {

class SoundFile {
 public:
  explicit SoundFile(std::string path) : path_(std::move(path)) {}
  /// What was heard since the last call.
  void take(Body& body) {
    if (const int rate = body.hear(samples_); rate > 0) rate_ = rate;
  }
  /// @return whether it was written; else says so
  bool close() const {
    const bool written = write_wav(path_, samples_, rate_);
    if (written)
      std::printf("sound    %s: %.1f s\n", path_.c_str(), static_cast<double>(samples_.size()) / rate_);
    else std::fprintf(stderr, "phantom: %s: the sound cannot be written\n", path_.c_str());
    return written;
  }

 private:
  std::string path_;
  std::vector<float> samples_;
  int rate_ = 1;  // [Hz]
};

}  // namespace phantom
