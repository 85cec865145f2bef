// Where a plane that stands for a circle touches a curve that yields, sought from push to push.
//
// Each push says where the next one goes.  In a bend about as sharp as the circle that leads away from the contact instead of to it: the
// way that is sought lies on the secant through the last two.
// Real-time: noexcept, no allocation, O(1).   Source: Anderson's mixing of depth one, J. ACM 12(4), 1965.
#pragma once

#include <cmath>

#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// The search for x = g(x), of x = (s, normal), from the last two images g and the residuals g - x.
/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class ContactSearch {
 public:
  using Residual = VectorOf<Scalar, D == 2 ? 2 : 4>;

  /// Where a push goes.
  struct Aim {
    Scalar s;                    // [m]
    VectorOf<Scalar, D> normal;  // unit
  };

  /// @param image  where the last push says that the next one goes   @param residual  how far that is, along and across [m]
  Aim after(const Aim& image, const Residual& residual) noexcept {
    const Residual change = residual - residual_;
    Scalar share = known_ ? residual.dot(change) / change.squaredNorm() : Scalar(0);
    if (!(std::abs(share) < most_share)) share = 0;
    Aim next = image;
    if (share != 0) {
      next.s -= share * (image.s - image_.s);
      next.normal = (image.normal - share * (image.normal - image_.normal)).normalized();
    }
    image_ = image;
    residual_ = residual;
    known_ = true;
    return next;
  }

 private:
  static constexpr Scalar most_share = 2;  // of the last step that is taken back or taken again
  Aim image_{0, VectorOf<Scalar, D>::Zero()};
  Residual residual_ = Residual::Zero();
  bool known_ = false;
};

}  // namespace hapbeam::detail
