// A simulated eye: reads each cube's heaviness from the displayed frames, in millimeters of the
// cue. It gets frames only: no mass, force or condition, and nothing of the hand's plans.
//
// Each frame in which the clone touches a cube gives a noisy reading of the cue, zero where it is
// less than just visible. Readings are smoothed over the eye's integration time; the largest one of
// an unbroken touch is a look, and the mean of a cube's looks is its percept. Without a drawn clone
// there is no cue. A participant who also feels the effector's weight mixes it in.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/Random.h"
#include "experiment/Stage.h"
#include "responders/ResponderParameters.h"

namespace heft {

class Perception {
 public:
  Perception(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial);

  void see(const DisplayedFrame& frame);

  /// By cube, leftmost first; 0 for a cube that was not looked at.
  std::vector<double> percepts_mm() const;

  /// Cubes (from 0) that were never seen touched.
  std::vector<int> not_looked_at() const;

  /// Discards all looks.
  void forget();

 private:
  /// An unbroken touch of one cube.
  struct Touch {
    int index = 0;
    double last_s = 0;
    double smoothed_mm = 0;
    Pose effector_at_start, cube_at_start;
    Pose cube;  ///< in the last frame
  };

  struct Look {
    double peak_mm = 0;     ///< largest smoothed reading
    double travel_mm = 0;   ///< of the hand since the touch began, largest
    double sliding_mm = 0;  ///< sum of the smoothed readings while the cube slides
    int n_sliding = 0;      ///< their number
  };

  void keep_touch(int cube, const DisplayedFrame& frame);
  double heaviness_mm(const Look& look) const;
  double with_felt_weight_mm(double seen_mm, double felt) const;
  double cue_mm(const DisplayedFrame& frame) const;
  double reading_mm(double shown_mm);

  ResponderParameters parameters_;
  Stage stage_;
  RandomStream stream_;
  std::optional<Touch> touch_;
  std::optional<double> last_frame_s_;
  std::vector<std::vector<Look>> looks_;  ///< by cube
  std::vector<double> felt_;  ///< by cube: standard normal noise of the weight; empty: not felt
};

}  // namespace heft
