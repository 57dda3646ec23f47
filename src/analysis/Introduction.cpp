#include "analysis/Introduction.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/Published.h"

namespace heft {

void IntroductionFold::add(const SessionData& data) {
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.completed() || attempt.trial.plan.task != "introduction") continue;
    if (!seen_.insert(data.participant()).second) continue;
    const auto n_selects = std::ranges::count(attempt.answers, "select", &AnswerRow::action);
    tally_.add(n_selects == 1);
    const std::string& condition = attempt.trial.plan.condition;
    conditions_.insert(condition);
    comparable_.add(data.published_condition(condition),
                    attempt.shows(published::introduction_masses_g));
  }
}

IntroductionSummary IntroductionFold::result() const {
  IntroductionSummary summary{rate_of_people(tally_), {}};
  summary.conditions = fmt::format("{}", fmt::join(conditions_, ", "));
  if (comparable_.condition() == published::Condition::decoupled)
    summary.published = &published::introduction_first_try;
  return summary;
}

}  // namespace heft
