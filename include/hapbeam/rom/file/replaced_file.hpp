// SPDX-License-Identifier: MIT
// A file that is replaced as a whole, or not at all.
//
//   ReplacedFile file("bar.json");
//   file.write(text);                  // or whoever else writes file.temporary()
//   file.replace();
//
// What is written stands beside the file, under a name that no other program has, until it is whole.  Without replace() it is removed.
// Permissions stay, and so does a symbolic link to the file.  Folders, devices, pipes and sockets are rejected.
// Offline: allocates and throws.
#pragma once

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <system_error>
#ifdef _WIN32
#include <io.h>
#endif

namespace hapbeam::detail {

class ReplacedFile {
  using Path = std::filesystem::path;

 public:
  /// @throws std::runtime_error naming the path and what is wrong with it
  [[gnu::cold]] explicit ReplacedFile(const std::string& path) : path_(path), target_(path) {
    find_target();
    make_temporary();
  }
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;
  [[gnu::cold]] ~ReplacedFile() {
    std::error_code ignored;
    if (file_) std::fclose(file_);
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
  }

  /// Where another program may write.
  std::string temporary() const { return temporary_.string(); }
  /// @throws std::runtime_error where the disk does not take it
  [[gnu::cold]] void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) reject(last_error());
  }
  /// @throws std::runtime_error, and the old file is as it was
  [[gnu::cold]] void replace() {
    std::FILE* const file = file_;
    file_ = nullptr;
    if (std::fclose(file) != 0) reject(last_error());
    std::error_code error;
    if (old_.type() == Type::regular) std::filesystem::permissions(temporary_, old_.permissions(), error);
    std::filesystem::rename(temporary_, target_, error);
    if (error) reject(error.message());
    temporary_.clear();
  }

 private:
  using Type = std::filesystem::file_type;

  [[noreturn]] void reject(const std::string& why) const {
    throw std::runtime_error(path_ + ": cannot be written: " + why);
  }
  static std::string last_error() {
    return errno ? std::generic_category().message(errno) : "unknown reason";
  }
  static const char* name(Type type) noexcept {
    switch (type) {
      case Type::directory: return "a folder";
      case Type::block:
      case Type::character: return "a device";
      case Type::fifo: return "a pipe";
      case Type::socket: return "a socket";
      default: return "of an unknown type";
    }
  }

  void find_target() {
    std::error_code error;
    old_ = std::filesystem::status(target_, error);  // follows links, and tells where they lead in a circle
    if (old_.type() == Type::none) reject(error.message());
    if (old_.type() != Type::regular && old_.type() != Type::not_found)
      reject(std::string("it is ") + name(old_.type()) + ": must be a regular file or a new one");
    while (std::filesystem::is_symlink(std::filesystem::symlink_status(target_, error))) {
      const Path next = std::filesystem::read_symlink(target_, error);
      if (error) reject(error.message());
      target_ = target_.parent_path() / next;  // an absolute one stands alone
    }
  }
  /// The name is drawn at random: no leftover of a program that was killed is in its way.
  void make_temporary() {
    std::random_device random;
    for (int k = 0; k < 16 && !file_; ++k) {
      char suffix[32];
      std::snprintf(suffix, sizeof suffix, ".%08x%08x.part", random(), random());
      const Path name = Path(target_) += suffix;
      if (open_new(name)) temporary_ = name;
      else if (errno != EEXIST) break;
    }
    if (!file_) reject(last_error());
  }
  /// Nobody else may read it before it has the permissions of the old one.
  bool open_new(const Path& name) {
    errno = 0;
#ifdef _WIN32
    const int made = _wopen(name.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
    file_ = made < 0 ? nullptr : _fdopen(made, "wb");
#else
    const int made = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC,
                          old_.type() == Type::regular ? 0600 : 0666);
    file_ = made < 0 ? nullptr : fdopen(made, "wb");
#endif
    return file_ != nullptr;
  }

  std::string path_;
  Path target_, temporary_;
  std::filesystem::file_status old_;
  std::FILE* file_ = nullptr;
};

}  // namespace hapbeam::detail
