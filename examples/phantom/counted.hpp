// A guarded model that counts how often its full model answered.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include <hapbeam/rom/trained/guarded.hpp>

namespace phantom {

template <class Fast, class Full>
class Counted : public hapbeam::Guarded<Fast, Full> {
  using Guarded = hapbeam::Guarded<Fast, Full>;

 public:
  /// @param full_answers  counts the presses that the full model answered; kept by reference
  Counted(Fast fast, Full full, std::atomic<std::uint64_t>& full_answers)
      : Guarded(std::move(fast), std::move(full)), count_(full_answers) {}

  auto press(const hapbeam::Press<typename Guarded::Scalar>& request) noexcept {
    const auto response = Guarded::press(request);
    if (this->full_answers()) count_.fetch_add(1, std::memory_order_relaxed);
    return response;
  }

 private:
  std::atomic<std::uint64_t>& count_;
};

}  // namespace phantom
