#include "analysis/dataset/StaircaseRuns.h"

#include "tasks/Comparison.h"

namespace heft {

void StaircaseRuns::add(const SessionData& data) {
  std::map<std::string, std::size_t> places;  // in this session, by staircase
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.is_usable_comparison()) continue;
    const TrialPlan& plan = attempt.trial.plan;
    const Compared compared{*plan.reference_g, plan.condition};
    PersonRuns& person = people_[compared][data.participant()];
    const Response response = Comparison::response_in(attempt.trial, PositiveAnswer::any_choice);
    if (plan.staircase.empty()) {
      person.n_catch += 1;
      person.n_catch_none += response.positive ? 0 : 1;
      continue;
    }
    const auto planned = data.staircases.find(plan.staircase);
    if (planned == data.staircases.end()) {
      unknown_.insert(compared);
      continue;
    }
    const auto [place, is_new] = places.try_emplace(plan.staircase, person.staircases.size());
    if (is_new) person.staircases.push_back(planned->second);
    person.staircases[place->second].choices.push_back({*plan.level_g, *response.choice});
  }
}

std::vector<PersonRuns> StaircaseRuns::at(const Compared& compared) const {
  std::vector<PersonRuns> people;
  const auto found = people_.find(compared);
  if (found == people_.end() || unknown_.contains(compared)) return people;
  for (const auto& [participant, runs] : found->second) people.push_back(runs);
  return people;
}

}  // namespace heft
