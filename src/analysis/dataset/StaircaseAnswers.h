// The answers along staircases whose estimates random answers give as well: those of judgments, and
// QUEST's of comparisons. QUEST+ and Psi test this themselves, and the paper's JND is what the
// paper's rule gives.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "analysis/dataset/Dataset.h"
#include "inference/checks/RandomAnswers.h"

namespace heft {

struct Compared;

class StaircaseAnswers {
 public:
  /// @param staircases of the session's estimates, by name
  void add(const SessionData& data, const std::map<std::string, Compared>& staircases);
  /// See p_of_random_answers(); none: not tested, or a procedure is unknown.
  std::optional<double> p_of_random(const Compared& compared) const;

 private:
  std::map<Compared, std::map<std::string, AnsweredLevels>> people_;
  std::set<Compared> unknown_;
};

}  // namespace heft
