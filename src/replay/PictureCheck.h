// The pictures of one logged attempt against what their effector poses give.
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
struct PictureCheckOptions {
  bool equal_bits = true;     ///< otherwise poses within 1e-6 m
  bool virtual_clock = true;  ///< every picture of the display's rate is there
  /// Called at the attempt's first difference: session time, what, logged, came out.
  std::function<void(double, const std::string&, const std::string&, const std::string&)> differ;
};

class PictureCheck {
 public:
  PictureCheck(const Protocol& protocol, const AttemptFold& attempt, PictureCheckOptions options);

  /// Runs the attempt again. Stops at the first difference.
  /// @param frames all of the attempt's, at least one
  void run(const std::vector<FrameRow>& frames);

  /// Largest distance of a pose from its logged one, where bits need not be equal.
  double largest_difference_m() const { return largest_difference_m_; }

 private:
  bool check(const FrameRow& frame, const ShownPicture& shown, int n_before);
  bool same(const FrameRow& frame, const char* column, const std::string& logged,
            const std::string& came_out);
  bool same_pose(const FrameRow& frame, const std::string& column,
                 const std::optional<Pose>& logged, const std::optional<Pose>& came_out);
  void check_end(const FrameRow& last);
  void check_events(const std::vector<Event>& derived);

  const Protocol& protocol_;
  const AttemptFold& attempt_;
  PictureCheckOptions options_;
  double largest_difference_m_ = 0;
};

}  // namespace heft
