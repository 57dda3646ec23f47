// Trial-by-trial levels of a session's staircases, for charts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Jnd.h"

namespace heft {

struct TrackPoint {
  double level_g = 0;   ///< as presented
  bool wrong = false;   ///< the lighter cube was chosen
  bool chosen = false;  ///< a cube was chosen, or the answer is positive or "different"
  bool is_reversal = false;
};

struct Track {
  std::string staircase;
  Compared compared;
  std::vector<TrackPoint> points;  ///< the staircase's completed trials in order
  std::optional<double> jnd_g;     ///< if `censored`, the value that it lies above or below
  Censored censored = Censored::none;
  /// For judgments: the question's key, and the answers that are positive or choose a cube.
  std::string question{};
  std::vector<std::string> positive{};
  bool chooses_cube = true;  ///< otherwise answers are positive or negative
  ComparisonAnswers answers = ComparisonAnswers::heavier_or_none;  ///< of comparisons
  bool has_estimate = true;  ///< whether such staircases estimate a JND or a threshold

  bool is_judgment() const { return !question.empty(); }
};

struct SessionTracks {
  std::int64_t session_id = 0;
  std::string participant;
  bool simulated = false, finished = false;
  std::vector<Track> tracks;  ///< by reference, then name
};

/// Every session that has adaptive staircases of comparisons, or of judgments whose question the
/// log has. Comparisons with two answers belong to their block, as judgments do.
class TracksCollector {
 public:
  void add(const SessionData& data);
  const std::vector<SessionTracks>& result() const& { return all_; }
  std::vector<SessionTracks> result() && { return std::move(all_); }

 private:
  std::vector<SessionTracks> all_;
};

/// Removes the estimates of staircases of a block, reference and condition.
void remove_estimates(std::vector<SessionTracks>& all, const Compared& compared);

/// The first finished one, or else the first; null: there is none.
const SessionTracks* example_of(const std::vector<SessionTracks>& all);

}  // namespace heft
