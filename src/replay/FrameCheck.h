// Compares the frames of a logged attempt with the simulation of their effector poses.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apparatus/TrialWorld.h"
#include "experiment/Rows.h"
#include "protocol/Protocol.h"
#include "replay/Projection.h"

namespace heft {

/// Tolerances, and the report of a difference.
struct FrameCheckOptions {
  bool equal_bits = true;     ///< otherwise poses within 1e-6 m
  bool same_edition = true;   ///< otherwise poses are only measured, and contacts not compared
  bool virtual_clock = true;  ///< frames are complete at the display's rate
  /// Called for the attempt's first difference: session time, what, logged, recomputed.
  std::function<void(double, const std::string&, const std::string&, const std::string&)> differ;
};

class FrameCheck {
 public:
  FrameCheck(const Protocol& protocol, const ProjectedAttempt& attempt, FrameCheckOptions options);

  /// Recomputes the attempt up to the first difference.
  /// @param frames all of the attempt's, at least one
  void run(const std::vector<FrameRow>& frames);

  /// Largest distance of a recomputed pose from the logged one, where bits may differ or poses are
  /// only measured.
  double largest_difference_m() const { return largest_difference_m_; }

 private:
  bool check(const FrameRow& frame, const ShownFrame& shown, int n_before);
  void measure(const FrameRow& frame, const ShownFrame& shown);
  bool same(const FrameRow& frame, const char* column, const std::string& logged,
            const std::string& replayed);
  bool same_pose(const FrameRow& frame, const std::string& column,
                 const std::optional<Pose>& logged, const std::optional<Pose>& replayed);
  void take_over_push(Event& replayed, const Event& logged);
  void check_end(const FrameRow& last);
  void check_events(const std::vector<Event>& derived);

  const Protocol& protocol_;
  const ProjectedAttempt& attempt_;
  FrameCheckOptions options_;
  double largest_difference_m_ = 0;
};

}  // namespace heft
