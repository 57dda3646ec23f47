// Just noticeable differences: what the staircases estimated, by reference mass.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "analysis/Dataset.h"
#include "analysis/Statistics.h"

namespace heft {

/// The estimates that are summarized: mean level of a staircase's reversals but the first ones.
inline constexpr std::string_view jnd_method = "mean_of_reversals";

/// What a staircase compared with, and how the clone was coupled; ordered by reference.
struct Compared {
  double reference_g = 0;
  std::string condition;

  auto operator<=>(const Compared&) const = default;
};

/// One finished staircase.
struct StaircaseResult {
  std::int64_t session_id = 0;
  std::string participant, staircase;
  Compared compared;
  std::optional<double> jnd_g;  ///< none: it ended with too few reversals
  int n_trials = 0, n_reversals = 0;
  int n_floor = 0, n_ceiling = 0;  ///< moves that a bound cut short
  bool at_trial_limit = false;     ///< ended by it, not by reversals
};

/// One participant's JND at a reference: the mean over sessions of each session's mean staircase.
struct ParticipantJnd {
  std::string participant;
  double jnd_g = 0;
};

struct ReferenceJnd {
  Compared compared;
  std::optional<double> mean_g, sd_g;  ///< over participants, n-1
  std::optional<Interval> interval_g;  ///< Student t; none for one participant or SD 0
  std::vector<ParticipantJnd> participants;
  int n_staircases = 0;  ///< finished
  int n_unfinished = 0;  ///< started in a session that did not finish them
  int n_without_estimate = 0;
  double mean_trials = 0;  ///< per finished staircase
  int least_trials = 0, most_trials = 0;
  int n_trial_limit = 0;           ///< staircases that it ended
  int n_floor = 0, n_ceiling = 0;  ///< hits, all staircases
  int n_floor_staircases = 0, n_ceiling_staircases = 0;
  std::optional<double> published_g, published_sd_g;
};

/// Names of a protocol's staircases whose kind has no jnd_method; none where the text is no
/// protocol.
std::set<std::string> staircases_without_jnd(const std::string& protocol_text);

/// Finished staircases in the order of sessions and estimates, each with the reference of its
/// trials.
std::vector<StaircaseResult> staircase_results(std::span<const SessionData> sessions);

/// By reference, lightest first, and condition. The paper's figures are beside its references in
/// C2.
std::vector<ReferenceJnd> jnd_of(std::span<const SessionData> sessions);

}  // namespace heft
