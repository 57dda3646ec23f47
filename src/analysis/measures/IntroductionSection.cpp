// The introduction: who found the heavier cube on the first try. Each participant's first completed
// one counts, as no one is untrained twice.
#include <fmt/format.h>

#include <set>

#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure first_try{"introduction_first_try", "%", "right on the first try",
                            "share of participants who selected exactly one cube in the "
                            "introduction; exact interval (Clopper-Pearson) over people"};

class IntroductionSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      if (!attempt.completed() || attempt.trial.plan.task != "introduction") continue;
      if (!seen_.insert(data.participant()).second) continue;
      people_.add(std::ranges::count(attempt.answers, "select", &AnswerRow::action) == 1);
      const std::string& condition = attempt.trial.plan.condition;
      conditions_.insert(condition);
      comparable_.add(data.published_condition(condition),
                      attempt.shows(published::introduction_masses_g));
    }
  }

  void put(Summary& summary) override {
    if (people_.n_trials == 0) return;
    StudyEstimate& estimate =
        summary.estimates.emplace_back(rate_estimate(first_try, rate_of_people(people_)));
    estimate.task = "introduction";
    estimate.condition = fmt::format("{}", fmt::join(conditions_, ", "));
    estimate.method = "exact";
    estimate.as_published = comparable_.condition() == published::Condition::decoupled;
    if (estimate.as_published) estimate.published = &published::introduction_first_try;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    const StudyEstimate* one = find_estimate(summary.estimates, first_try.name);
    if (!one) return {};
    std::string interval;
    if (one->low) interval = fmt::format(" [{:.0f}, {:.0f}]", *one->low, *one->high);
    return {fmt::format("Introduction: {} of {} correct on the first try, {:.0f} %{}.", one->n_hits,
                        one->n_trials, *one->value, interval)};
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable table{
        "introduction",
        "Introduction: right on the first try",
        {key_column("condition", "condition"),
         column(first_try, Field::n, "n_participants", "participants"),
         column(first_try, Field::n_hits, "n_first_try", "first try"),
         column(first_try, Field::value, "percent", "%", 1, "first_try.percent"),
         column(first_try, Field::low, "low_percent", "95 % low", 1, "first_try.low"),
         column(first_try, Field::high, "high_percent", "high", 1, "first_try.high"),
         column(first_try, Field::published, "published_percent", "published %", 1,
                "first_try.published"),
         column(first_try, Field::published_n, "published_n_participants", "published n", 0,
                "first_try.published_n")},
        "exactly one cube was selected; exact interval"};
    table.json = "introduction";
    return {table};
  }

 private:
  Tally people_;
  published::Comparable comparable_;
  std::set<std::string> conditions_, seen_;
};
}  // namespace

std::shared_ptr<Section> introduction_section() {
  return std::make_shared<IntroductionSection>();
}

}  // namespace heft
