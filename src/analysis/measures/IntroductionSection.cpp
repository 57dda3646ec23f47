// The introduction: who found the heavier cube on the first try.
#include "analysis/Introduction.h"
#include "analysis/Section.h"

namespace heft {

namespace {
constexpr Measure first_try{"introduction_first_try", "%", "right on the first try",
                            "share of participants who selected exactly one cube in the "
                            "introduction; exact interval (Clopper-Pearson) over people"};

class IntroductionSection final : public Section {
 public:
  void add(const SessionData& data) override { fold_.add(data); }

  void put(Summary& summary) override {
    summary.introduction = fold_.result();
    const Rate& rate = summary.introduction.first_try;
    if (!rate.percent) return;
    StudyEstimate estimate{&first_try, "introduction", summary.introduction.conditions};
    estimate.value = rate.percent;
    estimate.set(rate.interval_percent);
    estimate.n = estimate.n_trials = rate.trials.n_trials;
    estimate.n_hits = rate.trials.n_hits;
    estimate.method = "exact";
    estimate.published = summary.introduction.published;
    summary.estimates.push_back(std::move(estimate));
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
  IntroductionFold fold_;
};
}  // namespace

std::shared_ptr<Section> introduction_section() {
  return std::make_shared<IntroductionSection>();
}

}  // namespace heft
