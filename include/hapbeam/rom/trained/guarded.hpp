// SPDX-License-Identifier: MIT
// A fast model in its trained range, a full one elsewhere, as one ForceModel.
//
//   Guarded<PodModel<>, FemModel<>> model(load_model<PodModel<>>("bar.json"), FemModel<>(beam, 32));
//
// The fast model answers a press in its range if its status is ok. The full model answers all others. At the hand-over
// the force steps by the difference of the two, the fast model's error there.
// The full model is idle until it is required. It then starts from its last shape or from the undeformed one, whichever
// is closer: that first press takes about twice the solves of a moving one.
// Real-time: as both models; at most one press of each.
#pragma once

#include <type_traits>
#include <utility>

#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <class Fast, class Full>
class Guarded {
  static_assert(is_force_model<Fast> && is_force_model<Full>,
                "Guarded<Fast, Full>: both must be a ForceModel as listed in hapbeam/force_model.hpp");
  static_assert(std::is_same_v<typename Fast::Scalar, typename Full::Scalar>,
                "Guarded<Fast, Full>: both must have the same Scalar");

 public:
  using Scalar = typename Full::Scalar;

  /// Both are models of the same beam.
  Guarded(Fast fast, Full full) : fast_(std::move(fast)), full_(std::move(full)) {}

  /// @return as the model that answers; out_of_range where the press is in neither range
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    const Press<Scalar> nearest = fast_.range().nearest(request);
    if (nearest.s == request.s && nearest.d == request.d) {
      const Response<Scalar> response = fast_.press(request);
      if (response.status == Status::ok) return full_answers_ = false, response;
    }
    const Response<Scalar> response = full_.press(request);
    // An invalid request leaves everything as it was.
    if (response.status != Status::invalid_request) full_answers_ = true;
    return response;
  }

  Centreline<Scalar> shape() const noexcept { return full_answers_ ? full_.shape() : fast_.shape(); }
  /// The full model's.  A press in the fast model's alone is answered with ok too.
  Range<Scalar> range() const noexcept { return full_.range(); }
  Scalar thickness() const noexcept { return full_.thickness(); }
  void reset() noexcept {
    fast_.reset();
    full_.reset();
    full_answers_ = false;
  }

  /// Whether the last press was the full model's.
  bool full_answers() const noexcept { return full_answers_; }
  const Fast& fast() const noexcept { return fast_; }
  const Full& full() const noexcept { return full_; }

 private:
  Fast fast_;
  Full full_;
  bool full_answers_ = false;
};

}  // namespace hapbeam
