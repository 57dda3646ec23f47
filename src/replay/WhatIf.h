// What-if: the logged hand with another simulator or other parameters, or the logged trials with
// another responder.
#pragma once

#include <string>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "record/stream/EventSink.h"
#include "replay/VisibleCues.h"

namespace heft {

/// Difference of the visible cues in one kind of trial for cubes of one mass.
struct CueDifference {
  double mass_g = 0;
  VisibleCues logged, would_be;
};

/// Distance of bodies from their logged positions over all frames of one kind of trial.
struct PathDifference {
  Task task;
  std::string condition;  ///< technique
  int n_pictures = 0;
  double clone_rms_m = 0, clone_max_m = 0;
  double cubes_rms_m = 0, cubes_max_m = 0;
  std::vector<CueDifference> cues;  ///< by mass
  /// If the technique's lag depends on mass, as a spring's does (μ m g / k): grams per meter of
  /// lag.
  std::optional<double> logged_g_per_m, would_be_g_per_m;
};

/// Grams per meter of lag; none if the technique's lag does not depend on mass.
std::optional<double> grams_per_lag(const Protocol& protocol, const std::string& technique);

/// Simulates the logged effector poses with `protocol`'s physics. Trials without frames are
/// skipped.
std::vector<PathDifference> compare_paths(const LogReader& reader, const LoggedSession& session,
                                          const Protocol& protocol);

/// A staircase's estimate, as logged and with the other responder.
struct EstimateDifference {
  std::string staircase;
  std::optional<double> logged_g, would_be_g;
};

struct OutcomeDifference {
  Task task;
  std::string condition;                   ///< technique
  int n_logged = 0, n_logged_correct = 0;  ///< completed trials, and correct ones
  int n_would_be = 0, n_would_be_correct = 0;
};

struct OtherResponder {
  std::vector<OutcomeDifference> outcomes;
  std::vector<EstimateDifference> estimates;
};

/// Compares the logged session with its trials run with another responder.
OtherResponder compare_sessions(const LogReader& reader, std::int64_t session_id,
                                const RecordedSession& rerun);

}  // namespace heft
