// The world of one attempt: cubes that appear once the effector is clear of their places, physics
// (Drive), cubes that leave their area and are reset, and the touched cube. Runner and replay share
// it, so that a logged attempt is recomputed bit by bit. Times are seconds since the attempt's
// start.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Stage.h"
#include "experiment/TrialPlan.h"
#include "physics/Drive.h"
#include "protocol/Protocol.h"

namespace heft {

/// Whether a cube's center is outside the working area, or below the table.
bool is_out(const Layout& layout, const Eigen::Vector3d& center_m);

/// One displayed frame and its events.
struct ShownFrame {
  DisplayedFrame frame;
  std::optional<int> contact_slot;  ///< the cube pressed hardest
  std::string state_hash;
  std::vector<Event>
      events;  ///< cubes_shown, cube_contact, cubes_reset, effector_lost, effector_found
};

class TrialWorld {
 public:
  /// @param protocol must outlive this object
  TrialWorld(const Protocol& protocol, const TrialPlan& plan);

  /// Advances the world to the sample's time.
  ShownFrame advance(const TargetSample& sample);

  /// Replaces the cubes, as at the start of an attempt; they appear once the effector is clear.
  void rearrange(const TrialPlan& plan);

  /// Resets every cube to its start, as soon as the effector is clear of all of them.
  void request_reset() { reset_requested_ = true; }

  /// Ends the current contacts at the attempt's end.
  std::vector<Event> end_contacts(double t_s);

 private:
  struct Contact {
    std::optional<double> since_s, left_s;  // left: first frame without contact, if any
    Eigen::Vector3d from_m{0, 0, 0};        // the effector's position at since_s
    double max_push_displacement_m = 0, peak_lag_m = 0;
  };

  void advance_drive(const TargetSample& sample);
  bool clear_of(const Eigen::Vector3d& slot_m, const Pose& effector) const;
  bool clear_of_all(const Pose& effector) const;
  void note_view(const TargetSample& sample, ShownFrame& shown);
  void note_contacts(const TargetSample& sample, ShownFrame& shown);
  void touch(std::size_t cube, const TargetSample& sample, std::vector<Event>& events);
  void leave(std::size_t cube, double t_s, std::vector<Event>& events);
  void return_cubes(double t_s, ShownFrame& shown);
  bool go_back_together() const;
  bool is_out(std::size_t cube) const {
    return heft::is_out(protocol_.layout, drive_->state().cubes[cube].pose.position_m);
  }
  bool place_is_free(std::size_t cube) const;
  void end_contact(std::size_t cube, double end_s, double now_s, std::vector<Event>& events);

  const Protocol& protocol_;
  Stage stage_;
  Scene scene_;
  std::optional<Drive> drive_;  // exists once the cubes appear
  std::vector<Contact> contacts_;
  double last_s_ = 0;  // time of the last sample
  bool tracked_ = true;
  bool reset_requested_ = false;
};

}  // namespace heft
