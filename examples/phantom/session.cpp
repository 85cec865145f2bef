#include "session.hpp"

#include <utility>

namespace phantom {

Session::Session(const Options& options, std::shared_ptr<const Trained> trained, Hand& hand, Tape& tape)
    : device_(connect(options.device, hand)),
      body_(make_body(options, std::move(trained), device_->info())),
      relay_(*body_, device_->info(), tape, device_->simulated() ? &hand : nullptr) {}

void Session::change(const Options& options, std::shared_ptr<const Trained> trained,
                     const Eigen::Vector3d& from) {
  waiting_ = make_body(options, std::move(trained), device_->info());
  waiting_from_ = from;
  update();
}

void Session::update() {
  newest_ = relay_.newest();
  if (!relay_.settled()) return;
  if (next_) body_ = std::move(next_);
  if (!waiting_) return;
  next_ = std::move(waiting_);
  ++begun_;
  relay_.change(*next_, waiting_from_);
}

Body& Session::body() noexcept { return next_ && newest_.changes == begun_ ? *next_ : *body_; }

}  // namespace phantom
