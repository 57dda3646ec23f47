// A responder judges logged trials: it gets the logged frames of each completed trial, and its
// answer is compared with the logged one.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

/// The participant's answer to a trial and the responder's to the same frames, in the words of
/// TaskTrial::answer(): "reference", "comparison" (the chosen cube) or "none".
struct OfflineTrial {
  int trial_number = 0;
  Task task;
  std::string condition;  ///< technique
  std::optional<double> reference_g;
  bool has_difference = true;  ///< between the cubes' masses
  std::string logged, judged;
  /// For tasks with labels: by slot, "none" for a cube without one.
  std::vector<std::string> logged_labels, judged_labels;
};

struct OfflineAnswers {
  std::vector<OfflineTrial> trials;
  int n_without_frames = 0;  ///< completed trials without logged frames
  int n_without_answer = 0;  ///< completed trials that the responder does not answer
  double shown_s = 0;        ///< total duration of the judged frames
};

/// Judges every completed trial of the session; of the introduction, the frames up to the first
/// choice.
/// @param responder the logged one without a file gets its logged parameters
/// @param progress called with the fraction of trials done, 0...1
/// @throws Error (usage) for an unknown responder or a person; Error as sound_fold()
OfflineAnswers answer_session(const LogReader& reader, const LoggedSession& session,
                              const WhoAnswers& responder,
                              const std::function<void(double)>& progress);

/// Counts of logged against judged answers.
struct Confusion {
  std::map<std::pair<std::string, std::string>, int> n_by_pair;  ///< logged, judged

  void add(const std::string& logged, const std::string& judged) { ++n_by_pair[{logged, judged}]; }
  int n() const;
  int n_agree() const;
};

/// Trials of one task, technique and reference mass.
struct Agreement {
  Task task;
  std::string condition;
  std::optional<double> reference_g;
  Confusion answers;
  Confusion labels;  ///< of each cube, for tasks with labels
  /// For detection tasks that have trials with and without a difference (catch trials).
  std::optional<Detection> logged, judged;
};

/// By task, technique and reference.
std::vector<Agreement> agreements(const std::vector<OfflineTrial>& trials);

}  // namespace heft
