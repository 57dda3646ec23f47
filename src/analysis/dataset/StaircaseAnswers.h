// The answers along staircases whose estimates random answers give as well: those of judgments,
// QUEST's of comparisons, and those of same-different comparisons. QUEST+ and Psi test this
// themselves, and the paper's JND is what the paper's rule gives.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "analysis/dataset/Dataset.h"
#include "inference/checks/RandomAnswers.h"

namespace heft {

struct Compared;

/// The method of fits of same-different answers.
inline constexpr std::string_view same_different_method = "same_different";

class StaircaseAnswers {
 public:
  /// @param staircases that estimate something in the session, by name
  void add(const SessionData& data, const std::map<std::string, Compared>& staircases);
  /// See p_of_random_answers(); none: not tested, or a procedure is unknown.
  std::optional<double> p_of_random(const Compared& compared) const;
  /// Reason that the answers identify nothing: p is not below .05; empty: they may.
  std::string why_random(const Compared& compared) const;

 private:
  std::map<Compared, std::map<std::string, AnsweredLevels>> people_;
  std::set<Compared> unknown_;
};

}  // namespace heft
