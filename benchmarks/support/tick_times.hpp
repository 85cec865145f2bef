// The time of a tick, measured in rounds.
//
// Every model goes along its path once in each round, one model after another, and what is compared is measured in the
// same round: a machine that slows down does so for all.  Each tick is timed alone, as a servo waits for it, and what
// the clock itself takes in that round is taken off.  A clock may step by 10 ns, an eighth of the fastest tick: the
// value of a round is therefore not the median of its ticks but the mean of their middle half.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "statistics.hpp"
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

/// @param act  request -> answer   @param answer  out   @return [ns], the clock's own time included
template <class Request, class Act, class Answer>
double time_tick(Request request, Act& act, Answer& answer) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  benchmark::DoNotOptimize(request);  // neither earlier than the clock
  answer = act(request);
  benchmark::DoNotOptimize(answer);  // nor later
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

/// Times of one model: of all its ticks, and the value of each round.
struct ModelTimes {
  std::vector<double> ticks;   // [µs]
  std::vector<double> rounds;  // [µs]
  Status status = Status::ok;  // the first that was not ok

  double p50() const { return median(rounds); }
  double part(double quantile_part) const {
    std::vector<double> all = ticks;
    return quantile(all, quantile_part);
  }
};

class Rounds {
 public:
  /// One pass of a model along its path: appends the time of each tick in ns.  @return the first status not ok, or ok
  using Pass = std::function<Status(std::vector<double>& ns)>;

  void add(const std::string& name, Pass pass) { passes_.emplace_back(name, std::move(pass)); }

  /// @param act  Press -> Response, kept
  template <class Act>
  void add(const std::string& name, const std::vector<Press<double>>& path, Act act) {
    add(name, [path, act](std::vector<double>& ns) mutable {
      Response<double> response{};
      Status status = Status::ok;
      // Caches, and the branches that a processor learns.
      for (std::size_t k = path.size() - path.size() / 20; k < path.size(); ++k)
        time_tick(path[k], act, response);
      for (const Press<double>& press : path) {
        ns.push_back(time_tick(press, act, response));
        if (response.status != Status::ok && status == Status::ok) status = response.status;
      }
      return status;
    });
  }

  void run(int rounds) {
    for (int round = 0; round < rounds; ++round)
      for (auto& [name, pass] : passes_) {
        std::vector<double> ns;
        ModelTimes& times = times_[name];
        const Status status = pass(ns);
        if (times.status == Status::ok) times.status = status;
        if (ns.empty()) continue;
        const double clock = clock_ns();
        for (double& time : ns) time = (time - clock) * 1e-3;
        times.ticks.insert(times.ticks.end(), ns.begin(), ns.end());
        times.rounds.push_back(middle(ns));
      }
  }

  const ModelTimes& of(const std::string& name) const { return times_.at(name); }

  /// How often one is as fast as another: median over the rounds.
  double ratio(const std::string& slow, const std::string& fast) const {
    std::vector<double> ratios;
    const auto &a = of(slow).rounds, &b = of(fast).rounds;
    for (std::size_t round = 0; round < a.size() && round < b.size(); ++round)
      ratios.push_back(a[round] / b[round]);
    return median(ratios);
  }

 private:
  static double clock_ns() {
    std::vector<double> ns;
    Response<double> response{};
    const auto nothing = [](const Press<double>& press) { return Response<double>{press.d, Status::ok}; };
    for (int k = 0; k < 500; ++k) ns.push_back(time_tick(Press<double>{0, 0}, nothing, response));
    return middle(ns);
  }

  std::vector<std::pair<std::string, Pass>> passes_;
  std::map<std::string, ModelTimes> times_;
};

}  // namespace hapbeam::benchmarks
