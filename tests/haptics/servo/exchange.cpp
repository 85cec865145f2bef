// The newest value between two threads: whole, in order, and never waited for.
//
//   HAPBEAM_EXCHANGES=100000000 test_haptics "[exchange][thread]"
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include <hapbeam/haptics/servo/exchange.hpp>

using namespace hapbeam;

namespace {

/// As large as a drawn shape, and of no value whose parts come from two publications.
struct Record {
  static constexpr std::size_t size = 30;
  std::uint64_t number = 0;
  std::array<std::uint64_t, size> parts = filled(0);
  std::uint64_t sum = checksum(0, parts);

  static std::array<std::uint64_t, size> filled(std::uint64_t number) noexcept {
    std::array<std::uint64_t, size> parts{};
    for (std::size_t i = 0; i < size; ++i) parts[i] = (number + i) * 0x9e3779b97f4a7c15u;
    return parts;
  }
  static std::uint64_t checksum(std::uint64_t number, const std::array<std::uint64_t, size>& parts) noexcept {
    std::uint64_t sum = number;
    for (const std::uint64_t part : parts) sum = (sum << 7 | sum >> 57) ^ part;
    return sum;
  }
  void fill(std::uint64_t n) noexcept {
    number = n;
    parts = filled(n);
    sum = checksum(n, parts);
  }
  bool whole() const noexcept {
    return sum == checksum(number, parts) && parts[0] == number * 0x9e3779b97f4a7c15u;
  }
};

std::uint64_t exchanges() {
  const char* asked = std::getenv("HAPBEAM_EXCHANGES");
  return asked ? std::strtoull(asked, nullptr, 10) : 2'000'000;
}

static_assert(noexcept(std::declval<Exchange<Record>&>().publish()));
static_assert(noexcept(std::declval<Exchange<Record>&>().publish(std::declval<const Record&>())));
static_assert(noexcept(std::declval<Exchange<Record>&>().draft()));
static_assert(noexcept(std::declval<Exchange<Record>&>().update()));
static_assert(noexcept(std::declval<const Exchange<Record>&>().value()));
static_assert(
    !noexcept(std::declval<Exchange<std::vector<int>>&>().publish(std::declval<std::vector<int>&>())),
    "an assignment that allocates says so");

}  // namespace

TEST_CASE("the reader has the initial value until there is another", "[exchange]") {
  Exchange<int> exchange(7);
  CHECK(exchange.value() == 7);
  CHECK_FALSE(exchange.update());
  CHECK(exchange.value() == 7);
  exchange.publish(8);
  CHECK(exchange.value() == 7);  // not under the reader's hands
  CHECK(exchange.update());
  CHECK(exchange.value() == 8);
  CHECK_FALSE(exchange.update());
  CHECK(exchange.value() == 8);
}

TEST_CASE("only the newest of several values is read", "[exchange]") {
  Exchange<int> exchange;
  for (int i = 1; i <= 1000; ++i) {
    for (int k = 0; k < i % 7; ++k) exchange.publish(1000 * i + k);
    const bool fresh = exchange.update();
    REQUIRE(fresh == (i % 7 > 0));
    if (fresh) REQUIRE(exchange.value() == 1000 * i + i % 7 - 1);
  }
}

TEST_CASE("whatever the order of publishing and reading, three copies are never two at once", "[exchange]") {
  // Each sequence of twelve steps; writer, reader and the one between hold different copies, or a write would
  // show in the reader's hands.
  for (int steps = 0; steps < 1 << 12; ++steps) {
    Exchange<int> exchange(0);
    int written = 0, newest = 0, held = 0;
    for (int k = 0; k < 12; ++k) {
      exchange.draft() = -1;
      REQUIRE(exchange.value() == held);
      if (steps >> k & 1) {
        exchange.publish(++written);
        newest = written;
      } else {
        REQUIRE(exchange.update() == (newest != held));
        held = newest;
      }
      REQUIRE(exchange.value() == held);
    }
  }
}

TEST_CASE("a value that owns memory is filled in place", "[exchange]") {
  Exchange<std::vector<double>> exchange(std::vector<double>(100, 0.0));
  const double* places[3] = {};
  for (int i = 0; i < 3; ++i) {
    places[i] = exchange.draft().data();
    std::fill(exchange.draft().begin(), exchange.draft().end(), i);
    exchange.publish();
    exchange.update();
    CHECK(exchange.value().back() == i);
  }
  for (int i = 0; i < 9; ++i) {
    CHECK(std::count(places, places + 3, exchange.draft().data()) == 1);
    exchange.publish();
    exchange.update();
  }
}

TEST_CASE("no value is torn, none comes before one already read, and the last one arrives",
          "[exchange][thread]") {
  const std::uint64_t count = exchanges();
  Exchange<Record> exchange;
  const auto begin = std::chrono::steady_clock::now();
  std::thread writer([&]() noexcept {
    for (std::uint64_t n = 1; n <= count; ++n) {
      exchange.draft().fill(n);
      exchange.publish();
      if (n % 1024 == 0) std::this_thread::yield();  // where both share a processor
    }
  });
  std::uint64_t torn = 0, backward = 0, last = 0, taken = 0;
  while (last < count) {
    if (!exchange.update()) continue;
    const Record& record = exchange.value();
    torn += !record.whole();
    backward += record.number <= last;
    last = record.number;
    ++taken;
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(backward == 0);
  CHECK(taken > 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("%llu values published, %llu read, %.1f s, %.0f ns each\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(taken), seconds,
              1e9 * seconds / static_cast<double>(count));
  std::fflush(stdout);  // a test that forks would print it again
}

TEST_CASE("the checksum finds a value that is made of two", "[exchange]") {
  Record a, b;
  a.fill(1);
  b.fill(2);
  CHECK((a.whole() && b.whole()));
  for (std::size_t split = 0; split < Record::size; ++split) {
    Record torn = a;
    std::copy_n(b.parts.begin(), split + 1, torn.parts.begin());
    CHECK_FALSE(torn.whole());
    torn.number = b.number;
    CHECK_FALSE(torn.whole());
  }
}
