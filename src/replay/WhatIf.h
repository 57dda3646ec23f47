// What a logged session would have been: its hand through another simulator or other parameters, or
// its trials with another responder.
#pragma once

#include <string>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "record/RecordedSession.h"

namespace heft {

/// How far bodies end up from where they were logged, over all pictures of one kind of trial.
struct PathDifference {
  Task task = Task::sorting;
  std::string condition;  ///< technique
  int n_pictures = 0;
  double clone_rms_m = 0, clone_max_m = 0;
  double cubes_rms_m = 0, cubes_max_m = 0;
};

/// Runs the logged effector poses through `protocol`'s physics. Trials without pictures are
/// skipped.
std::vector<PathDifference> compare_paths(const LogReader& reader, const LoggedSession& session,
                                          const Protocol& protocol);

/// One staircase's estimate as logged and as it would have been.
struct EstimateDifference {
  std::string staircase;
  std::optional<double> logged_g, would_be_g;
};

struct OutcomeDifference {
  Task task = Task::sorting;
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
