#include "analysis/Introduction.h"

#include <algorithm>

#include "analysis/Published.h"

namespace heft {

void IntroductionFold::add(const SessionData& data) {
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.completed() || attempt.trial.plan.task != "introduction") continue;
    if (!seen_.insert(data.participant()).second) continue;
    const auto n_selects = std::ranges::count(attempt.answers, "select", &AnswerRow::action);
    tally_.add(n_selects == 1);
    as_published_ = as_published_ && attempt.shows(published::introduction_masses_g);
  }
}

IntroductionSummary IntroductionFold::result() const {
  IntroductionSummary summary{rate_of_people(tally_), {}, {}};
  if (tally_.n_trials == 0 || !as_published_) return summary;
  summary.published_n = published::n_participants;
  summary.published_percent = 100.0 * published::introduction_first_try / published::n_participants;
  return summary;
}

}  // namespace heft
