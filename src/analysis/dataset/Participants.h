// Participant flow, from consent to the analyzed sample, and exclusion by the protocol's rules.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "protocol/study/AnalysisPlan.h"

namespace heft {

/// Counts of one participant's sessions and trials, and why their data are excluded, if so.
struct ParticipantRow {
  std::string participant;
  int n_sessions = 0, n_finished = 0;
  int n_completed = 0;  ///< trials
  int n_anticipatory = 0, n_lost = 0, n_catch = 0, n_false_alarms = 0;
  std::string excluded_because;  ///< empty: not excluded

  bool excluded() const { return !excluded_because.empty(); }
};

/// Participants by name. The exclusion rules are those of their first session.
class ParticipantsCollector {
 public:
  void add(const SessionData& data);
  std::vector<ParticipantRow> result() const;

 private:
  struct Seen {
    ParticipantRow row;
    int n_attempts = 0;
    ExclusionRules rules;
  };
  std::map<std::string, Seen> participants_;
};

/// The analysis plan that all sessions' protocols declare; none unless they declare the same.
class PlanCollector {
 public:
  void add(const SessionData& data);
  std::optional<AnalysisPlan> result() const { return differ_ ? std::nullopt : plan_; }

 private:
  std::optional<AnalysisPlan> plan_;
  bool differ_ = false;
};

/// Numbers of participants.
struct ParticipantFlow {
  int n_asked = 0;                      ///< with a session in the log
  int n_withdrawn = 0;                  ///< of these, sessions whose data were removed
  int n_declined = 0;                   ///< did not agree to take part, in any session
  int n_started = 0;                    ///< began a trial
  int n_finished = 0;                   ///< finished a session
  int n_analyzed = 0;                   ///< in the figures
  int n_practice_trials = 0;            ///< attempts at practice trials, of all
  std::map<std::string, int> excluded;  ///< left out, by the rule that did it
  std::map<std::string, int>
      unfinished;  ///< started but finished none, by the last session's state
};

/// "anticipatory responses: 12 of 40, the protocol allows 5 %" is "anticipatory responses".
std::string in_short(const std::string& why);

class FlowCollector {
 public:
  void add(const SessionData& data);
  /// @param participants all, of the same sessions
  /// @param n_withdrawn sessions without data, which were not added
  ParticipantFlow result(std::span<const ParticipantRow> participants, int n_withdrawn = 0) const;

 private:
  struct Course {
    bool declined = false, agreed = false, started = false, finished = false;
    SessionState last = SessionState::running;
  };
  std::map<std::string, Course> courses_;
  int n_practice_trials_ = 0;
};

}  // namespace heft
