// What a logged session would have been: its hand through another simulator or other parameters, or
// its trials with another responder.
#pragma once

#include <string>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "record/stream/EventSink.h"
#include "replay/VisibleCues.h"

namespace heft {

/// What a participant would notice in one kind of trial of cubes of one mass.
struct CueDifference {
  double mass_g = 0;
  VisibleCues logged, would_be;
};

/// How far bodies end up from where they were logged, over all frames of one kind of trial.
struct PathDifference {
  Task task;
  std::string condition;  ///< technique
  int n_pictures = 0;
  double clone_rms_m = 0, clone_max_m = 0;
  double cubes_rms_m = 0, cubes_max_m = 0;
  std::vector<CueDifference> noticed;  ///< by mass
  /// Where the technique's lag tells mass, as a spring's does (μ m g / k): grams a meter of lag.
  std::optional<double> logged_g_per_m, would_be_g_per_m;
};

/// Grams that a meter of lag tells; none where the technique's lag tells no mass.
std::optional<double> grams_per_lag(const Protocol& protocol, const std::string& technique);

/// Runs the logged effector poses through `protocol`'s physics. Trials without frames are
/// skipped.
std::vector<PathDifference> compare_paths(const LogReader& reader, const LoggedSession& session,
                                          const Protocol& protocol);

/// One staircase's estimate as logged and as it would have been.
struct EstimateDifference {
  std::string staircase;
  std::optional<double> logged_g, would_be_g;
};

struct OutcomeDifference {
  Task task;
  std::string condition;                   ///< technique
  int n_logged = 0, n_logged_correct = 0;  ///< completed trials, and those rightly answered
  int n_would_be = 0, n_would_be_correct = 0;
};

struct OtherResponder {
  std::vector<OutcomeDifference> outcomes;
  std::vector<EstimateDifference> estimates;
};

/// The session as logged beside its trials run anew.
OtherResponder compare_sessions(const LogReader& reader, std::int64_t session_id,
                                const RecordedSession& anew);

}  // namespace heft
