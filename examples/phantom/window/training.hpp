// A reduced model of a scene's beam, trained on a thread of its own while the servo runs.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "../options.hpp"
#include "../trained.hpp"

namespace phantom {

class Training {
 public:
  /// Begins.  @param options  its beam and model_choice say what is trained
  explicit Training(const Options& options);
  ~Training();  ///< gives up what has not ended, and waits for that
  Training(const Training&) = delete;
  Training& operator=(const Training&) = delete;

  const Options& options() const noexcept { return options_; }
  double done() const noexcept { return done_.load(std::memory_order_relaxed); }  ///< 0 to 1, of the presses
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  /// Once it has ended.  @throws what ended it
  std::shared_ptr<const Trained> result() const;

 private:
  void run();

  const Options options_;
  std::shared_ptr<const Trained> trained_;
  std::exception_ptr failure_;
  std::atomic<double> done_{0};
  std::atomic<bool> given_up_{false}, ended_{false};
  std::thread thread_;
};

}  // namespace phantom
