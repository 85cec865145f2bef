// A session and what is seen of it: its last seconds, the drawing of its beam, other models' curves.
//
// What runs can be changed while it runs.  Model and coupling change under the hand, which goes on as it did; with another
// scene the hand is led to where its script begins.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "../hand.hpp"
#include "../options.hpp"
#include "../scene.hpp"
#include "../session.hpp"
#include "curves.hpp"
#include "drawing.hpp"
#include "history.hpp"

namespace phantom {

class Running {
 public:
  /// @param trained  as for make_body   @throws as Session
  Running(const Options& options, std::shared_ptr<const Trained> trained);

  void start() { session_.start(); }
  /// Once a picture.  @param visit  called with each tick since the last
  template <typename Visitor>
  void update(Visitor&& visit) {
    session_.update();
    show_newest();
    tape_.take([&](const Tick& tick) {
      if (tick.changes >= scene_since_) remember(tick);
      target_ = tick.hand.position;
      visit(tick);
    });
    refresh_curves();
  }
  /// To another body, of the same device.   @throws as Session::change
  void change(const Options& options, std::shared_ptr<const Trained> trained);
  /// The hand plays the script of the scene.
  void play();
  /// @param place  [m] device axes; kept within its reach   @return where that is
  Eigen::Vector3d pull(Eigen::Vector3d place);
  /// The hand is led to a place above the beam, as it was at the start, off a rod the way that its force goes; there it stays
  /// until it is pulled.
  void lift();

  Session& session() { return session_; }
  const Options& options() { return session_.body().options(); }
  const Options& asked() const { return asked_; }  ///< what is felt, or will be once it has changed
  const std::shared_ptr<const Trained>& asked_trained() const { return asked_trained_; }
  const History& history() const { return history_; }
  const std::vector<Curve>& curves() const { return curves_; }
  double curve_place() const { return curve_place_; }
  double curve_step() { return options().beam.length / 50; }  ///< [m] between places of curves
  double curve_depth() const { return curve_depth_; }
  const Eigen::Vector3d& target() const { return target_; }  ///< [m] device axes, newest
  std::uint64_t lost() const { return tape_.lost(); }        ///< ticks that were not taken
  bool pulled() const { return pulled_; }                    ///< the script has been left
  Drawing& drawing() { return *drawing_; }

 private:
  void remember(const Tick& tick);
  void show_newest();  ///< once another body is felt
  void show_body();
  void refresh_curves();
  double first_depth();                         ///< [m] of the curves before anything is pressed
  double place_of_curves();                     ///< [m] along the beam
  Eigen::Vector3d beside(const Options& next);  ///< [m] device axes: where it does not touch the next body

  Tape tape_;
  Hand hand_;
  Session session_;  // stops before what it refers to goes
  Options asked_, drawn_;
  std::shared_ptr<const Trained> asked_trained_;
  int shown_ = 0;        // changes of the session
  int scene_since_ = 0;  // changes
  std::unique_ptr<Drawing> drawing_;
  History history_;
  std::vector<Curve> curves_;
  double curve_place_ = -1, curve_depth_ = 0, deepest_ = 0;
  Eigen::Vector3d curve_along_{0, -1, 0};
  Eigen::Vector3d target_{0, height_above, 0};
  bool pulled_ = false;
};

}  // namespace phantom
