// One session and what is seen of it.  Switching builds the next one while this one runs; then this one stops, which
// makes the force zero, and the next starts with the hand above the beam, where the guard lets its force in gently.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "../hand.hpp"
#include "../options.hpp"
#include "../session.hpp"
#include "curves.hpp"
#include "draw_scene.hpp"
#include "history.hpp"

namespace phantom {

class Running {
 public:
  /// @param trained  or null   @throws as make_session
  Running(const Options& options, const Trained* trained);

  void start() { session_->start(); }
  /// Once a picture.  @param visit  called with each tick since the last
  template <typename Visitor>
  void update(Visitor&& visit) {
    tape_.take([&](const Tick& tick) {
      history_.add(tick, options().beam.rest(tick.record.press.s));
      target_ = tick.hand.position.head<2>();
      visit(tick);
    });
    refresh_curves();
  }
  /// @param place  [m] device axes; kept within its reach
  void pull(Point place);
  /// The hand is led to a place above the beam, as it was at the start, where it stays until it is pulled.
  void lift() { pull({target_.x(), height_above}); }

  Session& session() { return *session_; }
  const Options& options() const { return session_->options(); }
  const Trained* trained() const { return trained_; }
  const History& history() const { return history_; }
  const std::vector<Curve>& curves() const { return curves_; }
  double curve_place() const { return curve_place_; }
  double curve_depth() const { return curve_depth_; }
  const Point& target() const { return target_; }  ///< [m] device axes, newest
  bool pulled() const { return pulled_; }          ///< the script has been left
  SceneDrawing& drawing() { return *drawing_; }

 private:
  static constexpr double height_above = 0.02;  // [m]

  void refresh_curves();
  double depth_to_show() const;  ///< [m]

  const Trained* trained_;
  Tape tape_;
  std::unique_ptr<Hand> hand_;
  std::unique_ptr<Session> session_;  // stops before what it refers to goes
  std::optional<hapbeam::Beam> beam_;
  std::optional<SceneDrawing> drawing_;
  History history_;
  std::vector<Curve> curves_;
  double curve_place_ = -1, curve_depth_ = 0;
  Point target_{0, height_above};
  bool pulled_ = false;
};

}  // namespace phantom
