// The introduction: who found the heavier cube on the first try.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>

#include "analysis/Fold.h"
#include "inference/Proportion.h"

namespace heft {

struct IntroductionSummary {
  Rate first_try;          ///< of participants: exactly one `select`
  std::string conditions;  ///< those of the trials
  const published::Figure* published = nullptr;
};

/// Each participant's first completed introduction; nobody is untrained twice. Sessions in order.
class IntroductionFold {
 public:
  void add(const SessionData& data);
  IntroductionSummary result() const;

 private:
  Tally tally_;
  published::Comparable comparable_;
  std::set<std::string> conditions_;
  std::set<std::string> seen_;
};

inline IntroductionSummary introduction_of(std::span<const SessionData> sessions) {
  return folded<IntroductionFold>(sessions);
}

}  // namespace heft
