// Who took part, from the first question to the figures, and where people were lost on the way. How
// many were planned is not in a log.
#pragma once

#include <map>
#include <span>
#include <string>

#include "analysis/Dataset.h"
#include "analysis/Exclusion.h"

namespace heft {

/// Numbers of participants.
struct ParticipantFlow {
  int n_asked = 0;                      ///< with a session in the log
  int n_declined = 0;                   ///< did not agree to take part, in any session
  int n_started = 0;                    ///< began a trial
  int n_finished = 0;                   ///< finished a session
  int n_analyzed = 0;                   ///< in the figures
  std::map<std::string, int> excluded;  ///< left out, by the rule that did it
  std::map<std::string, int>
      unfinished;  ///< started but finished none, by the last session's state
};

/// "impossible answers: 12 of 40, the protocol allows 5 %" is "impossible answers".
std::string in_short(const std::string& why);

class FlowFold {
 public:
  void add(const SessionData& data);
  /// @param participants all, of the same sessions
  ParticipantFlow result(std::span<const ParticipantRow> participants) const;

 private:
  struct Way {
    bool declined = false, agreed = false, started = false, finished = false;
    SessionState last = SessionState::running;
  };
  std::map<std::string, Way> ways_;
};

/// @param participants all, of the same sessions
ParticipantFlow flow_of(std::span<const SessionData> sessions,
                        std::span<const ParticipantRow> participants);

}  // namespace heft
