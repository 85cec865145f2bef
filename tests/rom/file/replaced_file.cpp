// A file is replaced as a whole, or it is left as it was; what is no file is left alone.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <vector>

#include "support/catch.hpp"
#include <hapbeam/rom/file/replaced_file.hpp>

using Catch::Matchers::ContainsSubstring;
using hapbeam::detail::ReplacedFile;
namespace fs = std::filesystem;

namespace {

/// A folder of the test's own, empty at the beginning and removed at the end.
struct Folder {
  fs::path path = fs::absolute("replaced_file_" + std::to_string(std::random_device{}()));
  Folder() { fs::remove_all(path), fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(path)) all.push_back(entry.path().filename().string());
    return all;
  }
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}
void replace(const std::string& path, const std::string& text) {
  ReplacedFile file(path);
  file.write(text);
  file.replace();
}
std::string rejection(const std::string& path) {
  try {
    replace(path, "new");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a file is new or replaced, and nothing else is left", "[file]") {
  const Folder folder;
  const std::string path = folder / "a";
  replace(path, "one");
  CHECK(text_of(path) == "one");
  replace(path, std::string(1 << 20, 'x'));
  CHECK(text_of(path).size() == 1 << 20);
  CHECK(folder.names() == std::vector<std::string>{"a"});
  {
    ReplacedFile file(path);
    file.write("half");
    CHECK(text_of(path).size() == 1 << 20);
    CHECK(fs::path(file.temporary()).parent_path() == folder.path);
  }
  CHECK(text_of(path).size() == 1 << 20);
  CHECK(folder.names() == std::vector<std::string>{"a"});
}

TEST_CASE("a file that is replaced keeps its permissions", "[file]") {
  const Folder folder;
  const std::string path = folder / "a";
  std::ofstream(path) << "old";
  const auto mine = GENERATE(fs::perms::owner_read | fs::perms::owner_write,
                             fs::perms::owner_all | fs::perms::group_read | fs::perms::others_exec);
  fs::permissions(path, mine);
  replace(path, "new");
  CHECK(text_of(path) == "new");
  CHECK(fs::status(path).permissions() == mine);
}

TEST_CASE("a link stays, and the file to which it leads is replaced", "[file]") {
  const Folder folder;
  fs::create_directory(folder / "far");
  const std::string target = folder / "far/target", link = folder / "link";
  if (GENERATE(true, false)) std::ofstream(target) << "old";  // else it dangles
  SECTION("absolute") { fs::create_symlink(target, link); }
  SECTION("relative") { fs::create_symlink("far/target", link); }
  SECTION("to another one, beside the file") {
    fs::create_symlink("target", folder / "far/next");
    fs::create_symlink("far/next", link);
  }
  SECTION("through a folder that is one") {
    fs::create_directory_symlink("far", folder / "near");
    fs::create_symlink("near/../far/target", link);
  }
  replace(link, "new");
  CHECK(fs::is_symlink(fs::symlink_status(link)));
  CHECK_FALSE(fs::is_symlink(fs::symlink_status(target)));
  CHECK(text_of(target) == "new");
  CHECK(text_of(link) == "new");
}

TEST_CASE("what is no file is named and left alone", "[file]") {
  const Folder folder;
  const std::string path = folder / "a";
  std::string what;
  SECTION("a folder") { fs::create_directory(path), what = "a folder"; }
  SECTION("a pipe") {
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    what = "a pipe";
  }
  SECTION("a socket") {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return;  // a socket's name is short
    path.copy(address.sun_path, path.size());
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    REQUIRE(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    close(socket);
    what = "a socket";
  }
  SECTION("a link to a device") { fs::create_symlink("/dev/null", path), what = "a device"; }
  const fs::file_type before = fs::symlink_status(path).type();
  CHECK(rejection(path) ==
        path + ": cannot be written: it is " + what + ": must be a regular file or a new one");
  CHECK(fs::symlink_status(path).type() == before);
  CHECK(folder.names() == std::vector<std::string>{"a"});
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("what cannot be written is told", "[file]") {
  const Folder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK_THAT(rejection(folder / "a"), ContainsSubstring("a: cannot be written: Too many levels"));
  CHECK_THAT(rejection(folder / "no/such"), ContainsSubstring("no/such: cannot be written: No such file"));
  std::ofstream(folder / "c") << "old";
  CHECK_THAT(rejection(folder / "c/d"), ContainsSubstring("c/d: cannot be written: Not a directory"));
  // What others have left is neither in the way nor touched.
  for (int k = 0; k < 100; ++k) std::ofstream(folder / ("c.part" + std::to_string(k))) << "left";
  replace(folder / "c", "new");
  CHECK(text_of(folder / "c") == "new");
  for (int k = 0; k < 100; ++k) CHECK(text_of(folder / ("c.part" + std::to_string(k))) == "left");
  CHECK(folder.names().size() == 103);
}
