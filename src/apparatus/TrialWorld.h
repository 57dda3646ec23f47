// The world of one attempt as the participant meets it: cubes that appear once the effector is
// clear of their places, physics through Drive, cubes that leave their area and come back, and
// which cube is being touched. The runner and replay both use it, so a logged attempt runs again
// bit for bit. All times are seconds since the attempt's start.
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

/// One displayed frame and what happened in it.
struct ShownFrame {
  DisplayedFrame frame;
  std::optional<int> contact_slot;  ///< the cube pressed hardest
  std::string state_hash;
  std::vector<Event>
      events;  ///< cubes_shown, cube_contact, cubes_reset, effector_lost, effector_found
};

class TrialWorld {
 public:
  /// @param protocol outlives this
  TrialWorld(const Protocol& protocol, const TrialPlan& plan);

  /// Runs the world to the sample's time.
  ShownFrame advance(const TargetSample& sample);

  /// New cubes in the slots, as for a fresh attempt; they appear once the effector is clear.
  void rearrange(const TrialPlan& plan);

  /// Puts every cube back to its start, as soon as the effector is clear of all of them.
  void request_reset() { reset_requested_ = true; }

  /// The ends of contacts that are still going on, for when the attempt ends.
  std::vector<Event> end_contacts(double t_s);

 private:
  struct Contact {
    std::optional<double> since_s, left_s;  // left: first picture without it, if there was one
    Eigen::Vector3d from_m{0, 0, 0};        // the effector's place at since_s
    double max_push_displacement_m = 0, peak_lag_m = 0;
  };

  void advance_drive(const TargetSample& sample);
  bool clear_of(const Eigen::Vector3d& slot_m, const Pose& effector) const;
  bool clear_of_all(const Pose& effector) const;
  void note_view(const TargetSample& sample, ShownFrame& shown);
  void note_contacts(const TargetSample& sample, ShownFrame& shown);
  void return_cubes(double t_s, ShownFrame& shown);
  bool go_back_together() const;
  bool is_out(std::size_t cube) const;
  bool place_is_free(std::size_t cube) const;
  void end_contact(std::size_t cube, double end_s, double now_s, std::vector<Event>& events);

  const Protocol& protocol_;
  Stage stage_;
  Scene scene_;
  std::optional<Drive> drive_;  // from when the cubes appear
  std::vector<Contact> contacts_;
  bool tracked_ = true;
  bool reset_requested_ = false;
};

}  // namespace heft
