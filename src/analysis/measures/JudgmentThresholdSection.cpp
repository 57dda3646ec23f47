// Thresholds of judgments: the level that a procedure found for the answers to a question.
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure threshold{
    "judgment_threshold", "g", "threshold of judgments",
    "level that the procedure of a judgment found: of a single cube its mass, otherwise the "
    "difference from the reference; log-normal mean over participants"};
constexpr Measure n_censored{"judgment_threshold_n_censored", "", "censored",
                             "participants whose threshold is only known to lie above or below"};
constexpr Measure n_missing{"judgment_threshold_n_missing", "", "missing",
                            "participants without a threshold"};

std::string in_words(const std::string& method) {
  static const std::map<std::string, std::string> names{{"mean_of_reversals", "mean of reversals"},
                                                        {"quest", "QUEST"},
                                                        {"quest_plus", "QUEST+"},
                                                        {"psi", "Psi"}};
  const auto found = names.find(method);
  return found == names.end() ? method : found->second;
}

class JudgmentThresholdSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const auto& [block, asked] : data.judgments) questions_[block] = asked.question.key;
  }

  void put(Summary& summary) override {
    jnds_ = summary.shared->judgments.jnds();
    for (const ReferenceJnd& row : jnds_) {
      const Jnds& jnds = row.overall;
      StudyEstimate mean = at(threshold, row.compared);
      set_mean(mean, jnds);
      summary.estimates.push_back(std::move(mean));
      const auto put_number = [&](const Measure& measure, std::size_t n) {
        summary.estimates.push_back(at(measure, row.compared));
        summary.estimates.back().value = static_cast<double>(n);
      };
      put_number(n_censored, static_cast<std::size_t>(jnds.n_censored(Censored::above) +
                                                      jnds.n_censored(Censored::below)));
      put_number(n_missing, jnds.missing.size());
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const ReferenceJnd& row : jnds_)
      put_participants(all, at(threshold, row.compared), row.overall);
    return all;
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::vector<std::string> sentences;
    for (const StudyEstimate& one : summary.estimates) {
      if (one.measure != &threshold) continue;
      const std::string beside =
          one.reference_g ? fmt::format(" more than {:g} g", *one.reference_g) : "";
      const std::string found =
          one.value ? fmt::format("{} g{}{}", in_grams(*one.value), grams_between(one), beside)
                    : "not identifiable" +
                          (one.reference_g ? fmt::format(" at {:g} g", *one.reference_g) : "");
      const std::string why = one.value ? "" : fmt::format(" ({})", one.why);
      sentences.push_back(fmt::format("Threshold of \"{}\" ({}): {} {}{}.", one.text_at("block"),
                                      in_words(one.text_at("method")), found,
                                      in_condition(summary, one.condition), why));
    }
    return sentences;
  }

  std::vector<EstimateTable> tables() const override {
    const std::vector<EstimateColumn> place{
        key_column("block", "block"), key_column("question", "question"),
        key_column("condition", "condition"), key_column("reference_g", "reference g"),
        key_column("method", "method")};
    EstimateTable means{
        "judgment_threshold",
        "Thresholds of judgments, mean over participants",
        place,
        "what the procedures of judgments estimated, as for JNDs: of a single "
        "cube (no reference) the mass, otherwise the difference from the "
        "reference; censored: known only to lie above or below. A threshold needs answers "
        "of all participants together that depend on the level more than random answers in the "
        "same procedures do (likelihood ratio, p < .05, simulated)",
        TablePlace::results,
        "judgment_threshold[]"};
    for (EstimateColumn& one :
         std::vector{column(threshold, Field::value, "mean_g", "threshold g"),
                     column(threshold, Field::sd, "sd_g", "SD"),
                     column(threshold, Field::low, "low_g", "95 % low"),
                     column(threshold, Field::high, "high_g", "high"),
                     column(threshold, Field::n, "n", "n"),
                     column(n_censored, Field::value, "n_censored", "censored", 0),
                     column(n_missing, Field::value, "n_missing", "missing", 0)})
      means.columns.push_back(std::move(one));
    means.columns.push_back(column(threshold, Field::why, "why", "no threshold: why"));
    EstimateTable people{"judgment_threshold_by_participant", "Each participant's thresholds",
                         place, "", TablePlace::csv};
    people.participants = true;
    people.columns.push_back(key_column("participant", "participant"));
    people.columns.push_back(column(threshold, Field::value, "threshold_g", "threshold g"));
    people.columns.push_back(column(threshold, Field::censored, "censored", "censored"));
    return {means, people};
  }

 private:
  StudyEstimate at(const Measure& measure, const Compared& compared) const {
    StudyEstimate estimate{&measure, "judgment", compared.condition};
    if (compared.reference_g > 0) estimate.reference_g = compared.reference_g;
    const auto question = questions_.find(compared.block);
    estimate.by = {{"block", compared.block},
                   {"question", question == questions_.end() ? "" : question->second},
                   {"method", compared.method}};
    return estimate;
  }

  std::map<std::string, std::string> questions_;  // by block
  std::vector<ReferenceJnd> jnds_;
};
}  // namespace

std::shared_ptr<Section> judgment_threshold_section() {
  return std::make_shared<JudgmentThresholdSection>();
}

}  // namespace heft
