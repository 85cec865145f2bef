// Histograms of tick times: what a quantile promises, and what counts as missed.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/servo/tick_times.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

struct Watch {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<Watch>;
  static constexpr bool is_steady = true;
  static inline std::int64_t time = 0;
  static time_point now() noexcept { return time_point(duration(time)); }
};
using Times = BasicTickTimes<Watch>;

/// A tick that begins so long after the beginning of the last one, and takes so long [ns].
void tick(Times& times, std::int64_t after, std::int64_t takes) {
  Watch::time += after;
  times.begin();
  Watch::time += takes;
  times.end();
  Watch::time -= takes;
}

}  // namespace

TEST_CASE("a quantile is reached by its share of times and is at most 1/64 too long", "[tick_times]") {
  Random random(1);
  for (const double decades : {0.1, 1.0, 3.0, 9.0}) {
    TimeHistogram histogram;
    std::vector<std::int64_t> times;
    for (int i = 0; i < 20000; ++i) {
      times.push_back(static_cast<std::int64_t>(std::pow(10, random(1, 1 + decades))));
      histogram.add(times.back());
    }
    std::sort(times.begin(), times.end());
    for (const double part : {0.0001, 0.01, 0.5, 0.9, 0.99, 0.999, 0.99999}) {
      const auto rank = static_cast<std::size_t>(std::ceil(part * 20000)) - 1;
      const double exact = static_cast<double>(times[rank]) * 1e-9;
      REQUIRE(histogram.quantile(part) >= exact * (1 - 1e-15));
      REQUIRE(histogram.quantile(part) <= exact * (1 + 1 / 64.0) * (1 + 1e-15));
    }
    CHECK(histogram.longest() == static_cast<double>(times.back()) * 1e-9);
    CHECK(histogram.quantile(1) == histogram.longest());
    CHECK(histogram.count() == 20000);
    const TimeSummary summary = histogram.summary();
    CHECK(summary.count == 20000);
    CHECK(summary.p50 == histogram.quantile(0.5));
    CHECK(summary.p99 == histogram.quantile(0.99));
    CHECK(summary.p999 == histogram.quantile(0.999));
    CHECK(summary.max == histogram.longest());
  }
}

TEST_CASE("times at the borders of bins, impossible ones and endless ones have their place", "[tick_times]") {
  for (int power = 0; power < 39; ++power)
    for (const std::int64_t off : {-1, 0, 1}) {
      const std::int64_t time = (std::int64_t(1) << power) + off;
      TimeHistogram histogram;
      histogram.add(time);
      histogram.add(time * 16);
      const double exact = static_cast<double>(time) * 1e-9;
      REQUIRE(histogram.quantile(0.5) >= exact * (1 - 1e-15));
      REQUIRE(histogram.quantile(0.5) <= exact * (1 + 1 / 64.0) * (1 + 1e-15));
    }
  TimeHistogram histogram;
  CHECK(histogram.quantile(0.5) == 0);
  CHECK(histogram.summary().max == 0);
  histogram.add(-5);
  CHECK(histogram.quantile(1) == 0);
  CHECK(histogram.count() == 1);
  histogram.add(std::numeric_limits<std::int64_t>::max());
  CHECK(histogram.quantile(0.5) == 0);
  CHECK(histogram.quantile(0.9) == Approx(9.223372036854775807e9));
}

TEST_CASE("periods go from beginning to beginning, compute times from beginning to end", "[tick_times]") {
  Times times(1e-3);
  for (int i = 0; i < 1000; ++i) tick(times, 1000000, i < 990 ? 20000 : 50000);
  CHECK(times.compute().count() == 1000);
  CHECK(times.period().count() == 999);
  CHECK(times.missed() == 0);
  CHECK(times.compute().quantile(0.5) == Approx(20e-6).epsilon(1 / 64.0));
  CHECK(times.compute().quantile(0.995) == Approx(50e-6).epsilon(1 / 64.0));
  CHECK(times.compute().longest() == Approx(50e-6).epsilon(1e-15));
  CHECK(times.period().longest() == Approx(1e-3).epsilon(1e-15));
}

TEST_CASE("a deadline is missed when a whole period has passed without its tick", "[tick_times]") {
  Times times(1e-3);
  tick(times, 0, 0);
  tick(times, 1999999, 0);
  CHECK(times.missed() == 0);
  tick(times, 2000000, 0);
  CHECK(times.missed() == 1);
  tick(times, 5500000, 0);
  CHECK(times.missed() == 5);
  times.pause();
  tick(times, 9000000000, 0);
  CHECK(times.missed() == 5);
  CHECK(times.period().longest() == Approx(5.5e-3).epsilon(1e-15));
}

TEST_CASE("a period is one of a loop: of a shorter one no nanosecond is left to count", "[tick_times]") {
  for (const double period : {1e-300, 1e-10, 1e4, 1e300})
    CHECK_THROWS_WITH(TickTimes(period), ContainsSubstring("must be 1e-6 to 1e3"));
  CHECK_NOTHROW(TickTimes(1e-6));
  CHECK_THROWS_WITH(TickTimes(0), ContainsSubstring("period = 0 s"));
  CHECK_THROWS_AS(TickTimes(-1e-3), std::invalid_argument);
  CHECK_THROWS_AS(TickTimes(std::nan("")), std::invalid_argument);
}

// Many short histograms, each read from its first time on: beginnings and growth are where a reader sees parts.
TEST_CASE("it is read while it is written: counts grow and quantiles stay in range", "[tick_times][thread]") {
  bool in_range = true, growing = true;
  for (int round = 0; round < 100; ++round) {
    TimeHistogram histogram;
    std::atomic<bool> read{false}, done{false};
    std::uint64_t added = 0;
    std::thread servo([&] {
      for (int time = 2000; time > 1000 || !read; ++added) histogram.add(time > 1000 ? time-- : time);
      done = true;
    });
    std::uint64_t last = 0;
    while (!done) {
      const TimeSummary summary = histogram.summary();
      growing &= summary.count >= last;
      last = summary.count;
      if (last == 0) continue;
      read = true;
      in_range &= summary.p50 >= 1000 * 1e-9 && summary.p50 <= summary.p99 && summary.p99 <= summary.p999 &&
                  summary.p999 <= summary.max && summary.max == 2000 * 1e-9;
    }
    servo.join();
    growing &= histogram.count() == added;
  }
  CHECK(in_range);
  CHECK(growing);
}
