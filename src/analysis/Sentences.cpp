// The three sentences on top of a report.
#include <fmt/format.h>

#include "analysis/Notes.h"

namespace heft {

namespace {
const Hypothesis& named(const Summary& summary, std::string_view name) {
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.name == name) return hypothesis;
  return summary.hypotheses.front();
}

std::string percent(const Proportion& proportion) {
  if (!proportion.mean_percent) return "-";
  std::string text = fmt::format("{:.0f} %", *proportion.mean_percent);
  if (proportion.interval_percent)
    text += fmt::format(" [{:.0f}, {:.0f}]", proportion.interval_percent->low,
                        proportion.interval_percent->high);
  return text;
}

// Chance is of answers: who doesn't know is neither right nor wrong.
std::string answered(const ConditionSorting& sorting) {
  std::string text = percent(sorting.answered_correct) + " of the answered trials in C1";
  if (sorting.none.mean_percent.value_or(0) > 0)
    text += fmt::format(" ({:.0f} % were \"I don't know\")", *sorting.none.mean_percent);
  return text;
}

std::string who(const Summary& summary) {
  const std::string people = fmt::format("{} {}participant{}", summary.n_participants,
                                         summary.data == "simulated" ? "simulated " : "",
                                         summary.n_participants == 1 ? "" : "s");
  return summary.data == "human and simulated" ? people + " (persons and models mixed)" : people;
}

std::string sorting_sentence(const Summary& summary) {
  const ConditionSorting &c1 = summary.sorting.at(0), &c2 = summary.sorting.at(1);
  if (c1.n_trials + c2.n_trials == 0)
    return fmt::format("Sorting: of {} nobody completed a trial, so nothing is said of it.",
                       who(summary));
  std::string blind = ", and whether C1 tells masses apart can't be judged";
  const HypothesisVerdict verdict = named(summary, "E1-H1").verdict;
  if (verdict == HypothesisVerdict::supported)
    blind = fmt::format(", and answers in C1 are equivalent to chance (within {:g} points)",
                        equivalence_margin_percent(summary));
  if (verdict == HypothesisVerdict::not_supported) blind = ", and answers in C1 are not chance";
  std::string worked = "whether C2 tells masses apart can't be judged";
  if (named(summary, "E1-H2").verdict == HypothesisVerdict::supported)
    worked = "C2 tells masses apart";
  if (named(summary, "E1-H2").verdict == HypothesisVerdict::not_supported)
    worked = "C2 tells masses apart hardly or not at all (at most 10 points above chance)";
  return fmt::format(
      "Sorting: {}; of {}, {} of trials were right in C2 and {}, where chance is {:.0f} %{}.",
      worked, who(summary), percent(c2.correct), answered(c1),
      c2.chance_percent().value_or(c1.chance_percent().value_or(0)), blind);
}

std::string comparison_sentence(const Summary& summary) {
  if (summary.sensitivity.empty()) return "Comparisons: none were completed.";
  std::string known, unknown;
  for (const ReferenceSensitivity& row : summary.sensitivity) {
    const PooledSensitivity& pooled = row.pooled;
    if (pooled.identifiable())
      known += fmt::format("{}{:.0f} g [{:.0f}, {:.0f}] at {:g} g", known.empty() ? "" : ", ",
                           *pooled.threshold_75_g, pooled.threshold_interval_g->low,
                           pooled.threshold_interval_g->high, row.compared.reference_g);
    else
      unknown += fmt::format("{}{:g} g", unknown.empty() ? "" : ", ", row.compared.reference_g);
  }
  std::string text = "Comparisons: ";
  if (!known.empty())
    text += fmt::format(
        "by the model, people who had to choose would be right three times in four at a difference "
        "of {}",
        known);
  if (!unknown.empty())
    text += fmt::format("{}the data bear no threshold at {}", known.empty() ? "" : "; ", unknown);
  return text + ".";
}

std::string limits_sentence(const Summary& summary) {
  std::string open;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.verdict == HypothesisVerdict::not_judged)
      open += (open.empty() ? "" : ", ") + hypothesis.name;
  std::string text =
      summary.plan ? "What they can't say: what the protocol did not declare is exploratory"
                   : "What they can't say: no analysis was declared beforehand, so all of it is "
                     "exploratory";
  if (summary.simulated())
    text += summary.data == "simulated"
                ? "; a model answered, so nothing of this is about people"
                : "; a model answered a part of it, so it is not about people alone";
  if (!summary.jnd.empty())
    text +=
        "; the paper's JND follows the criterion and the start, so it is no measure of what "
        "people perceive";
  if (!open.empty()) text += fmt::format("; {} can't be judged", open);
  return text + ".";
}
}  // namespace

std::vector<std::string> three_sentences(const Summary& summary) {
  return {sorting_sentence(summary), comparison_sentence(summary), limits_sentence(summary)};
}

}  // namespace heft
