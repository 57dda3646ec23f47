#include "analysis/Introduction.h"

#include <algorithm>
#include <set>
#include <string>

#include "analysis/Published.h"

namespace heft {

namespace {
bool has_published_masses(const Attempt& attempt) {
  std::vector<double> masses = attempt.masses_g();
  std::ranges::sort(masses);
  return std::ranges::equal(masses, published::introduction_masses_g);
}
}  // namespace

IntroductionSummary introduction_of(std::span<const SessionData> sessions) {
  Tally tally;
  bool as_published = true;
  std::set<std::string> seen;
  for (const SessionData& data : sessions) {
    for (const Attempt& attempt : data.attempts) {
      if (!attempt.completed() || attempt.trial.plan.task != Task::introduction) continue;
      if (!seen.insert(data.participant()).second) continue;
      const auto n_selects =
          std::ranges::count(attempt.answers, ActionKind::select, &AnswerRow::action);
      tally.n_trials += 1;
      tally.n_hits += n_selects == 1 ? 1 : 0;
      as_published = as_published && has_published_masses(attempt);
    }
  }
  IntroductionSummary summary{rate_of_people(tally), {}, {}};
  if (tally.n_trials == 0 || !as_published) return summary;
  summary.published_n = published::n_participants;
  summary.published_percent = 100.0 * published::introduction_first_try / published::n_participants;
  return summary;
}

}  // namespace heft
