// Models judge logged trials: each gets the logged frames of every completed trial, and the answers
// that it draws are compared with the logged one. No draw depends on the session's random streams.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "replay/AnswerScores.h"

namespace heft {

struct JudgeRequest {
  std::vector<ResponderChoice> responders;  ///< models; at least one
  int repeats = 100;                        ///< draws of each answer, at least 2
  /// Of the models' random streams, whose keys are also the model's name, the session's number and
  /// the draw.
  std::uint64_t seed = 1;
};

/// Why a trial has no score.
struct LeftOutTrial {
  std::int64_t session_id = 0;
  int trial_number = 0;
  std::string why;
};

struct Judgments {
  std::vector<JudgedTrial> trials;
  std::vector<LeftOutTrial> left_out;  ///< every other attempt at a trial
  double shown_s = 0;                  ///< total duration of the judged trials' frames

  void add(Judgments more);
};

// Why trials are left out. A model without an answer: no_answer_of(its name).
inline constexpr std::string_view is_voided = "voided", is_open = "not completed",
                                  is_practice = "practice",
                                  lacks_frames = "without frames in the log",
                                  is_untouched = "in which no cube was touched",
                                  is_a_number = "answered by a number";
std::string no_answer_of(std::string_view responder);

/// Judges every completed trial of the session; of the introduction, the frames up to the first
/// choice. A trial that one of the models does not answer is left out for all.
///
/// Without a file, the model that was logged has the parameters that it had in this session. Any
/// other model draws new parameters each time, so that its probabilities are those of an unknown
/// person.
/// @param what_if the logged hand under this protocol's physics; null: the logged frames
/// @param progress called with the fraction of trials done, 0...1
/// @throws Error (usage) for an unknown responder or a person; Error as sound_fold()
Judgments judge_session(const LogReader& reader, const LoggedSession& session,
                        const JudgeRequest& request, const Protocol* what_if,
                        const std::function<void(double)>& progress);

}  // namespace heft
