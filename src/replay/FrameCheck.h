// The frames of one logged attempt against what their effector poses give.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apparatus/TrialWorld.h"
#include "experiment/Rows.h"
#include "protocol/Protocol.h"
#include "replay/Projection.h"

namespace heft {

/// How exactly, and who is told.
struct FrameCheckOptions {
  bool equal_bits = true;     ///< otherwise poses within 1e-6 m
  bool same_edition = true;   ///< otherwise poses are only measured, and contacts not compared
  bool virtual_clock = true;  ///< every frame of the display's rate is there
  /// Called at the attempt's first difference: session time, what, logged, came out.
  std::function<void(double, const std::string&, const std::string&, const std::string&)> differ;
};

class FrameCheck {
 public:
  FrameCheck(const Protocol& protocol, const AttemptFold& attempt, FrameCheckOptions options);

  /// Runs the attempt again. Stops at the first difference.
  /// @param frames all of the attempt's, at least one
  void run(const std::vector<FrameRow>& frames);

  /// Largest distance of a pose from its logged one, where bits need not be equal
  /// or poses are only measured.
  double largest_difference_m() const { return largest_difference_m_; }

 private:
  bool check(const FrameRow& frame, const ShownFrame& shown, int n_before);
  void measure(const FrameRow& frame, const ShownFrame& shown);
  bool same(const FrameRow& frame, const char* column, const std::string& logged,
            const std::string& came_out);
  bool same_pose(const FrameRow& frame, const std::string& column,
                 const std::optional<Pose>& logged, const std::optional<Pose>& came_out);
  void take_over_push(Event& came_out, const Event& logged);
  void check_end(const FrameRow& last);
  void check_events(const std::vector<Event>& derived);

  const Protocol& protocol_;
  const AttemptFold& attempt_;
  FrameCheckOptions options_;
  double largest_difference_m_ = 0;
};

}  // namespace heft
