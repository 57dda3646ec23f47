// The sentences on top of a report.
#include <fmt/format.h>

#include "analysis/Notes.h"

namespace heft {

namespace {
const Hypothesis& named(const Summary& summary, std::string_view name) {
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.name == name) return hypothesis;
  return summary.hypotheses.front();
}

std::string percent(const StudyEstimate& share) {
  if (!share.value) return "-";
  std::string text = fmt::format("{:.0f} %", *share.value);
  if (share.low) text += fmt::format(" [{:.0f}, {:.0f}]", *share.low, *share.high);
  return text;
}

std::string who(const Summary& summary) {
  const std::string people = fmt::format("{} {}participant{}", summary.n_participants,
                                         summary.data == "simulated" ? "simulated " : "",
                                         summary.n_participants == 1 ? "" : "s");
  return summary.data == "human and simulated" ? people + " (persons and models mixed)" : people;
}

// Chance is of answers: who doesn't know is neither right nor wrong.
std::string sorting_in_words(const Summary& summary, const StudyEstimate& correct) {
  const std::string& name = correct.condition;
  const auto of = [&](std::string_view measure, std::string_view trials, std::string_view answer) {
    return *find_estimate(summary.estimates, measure,
                          {{"condition", name}, {"trials", trials}, {"answer", answer}});
  };
  const double none_percent = of("sorting_answers", "all", "I don't know").value.value_or(0);
  std::string text = fmt::format("{} of trials were correct in {}", percent(correct), name);
  if (none_percent > 0)
    text += fmt::format(" and {} of the answered trials in {} ({:.0f} % were \"I don't know\")",
                        percent(of("sorting_answers", "answered", "correct")), name, none_percent);
  return text + fmt::format(", where chance is {:.0f} %",
                            of("sorting_chance", "all", "correct").value.value_or(0));
}

// What the paper's hypotheses come to, of those of its conditions that were run.
std::string verdicts_in_words(const Summary& summary) {
  const Hypothesis &blind = named(summary, "E1-H1"), &works = named(summary, "E1-H2");
  std::string text;
  if (!works.condition.empty()) {
    std::string verdict =
        fmt::format("whether masses are discriminated in {} is inconclusive", works.condition);
    if (works.verdict == HypothesisVerdict::supported)
      verdict = fmt::format("masses are discriminated in {}", works.condition);
    if (works.verdict == HypothesisVerdict::not_supported)
      verdict = fmt::format(
          "masses are hardly or not discriminated in {} (at most 10 points above chance)",
          works.condition);
    text += "; " + verdict;
  }
  if (!blind.condition.empty()) {
    std::string verdict =
        fmt::format("whether masses are discriminated in {} is inconclusive", blind.condition);
    if (blind.verdict == HypothesisVerdict::supported)
      verdict = fmt::format("answers in {} are equivalent to chance (within {:g} points)",
                            blind.condition, equivalence_margin_percent(summary));
    if (blind.verdict == HypothesisVerdict::not_supported)
      verdict = fmt::format("answers in {} are not chance", blind.condition);
    text += "; " + verdict;
  }
  return text;
}

std::string sorting_sentence(const Summary& summary) {
  std::string text;
  for (const StudyEstimate* correct : estimates_of(summary.estimates, "sorting_answers",
                                                   {{"trials", "all"}, {"answer", "correct"}}))
    if (correct->value) text += (text.empty() ? "" : "; ") + sorting_in_words(summary, *correct);
  if (text.empty()) return fmt::format("Sorting: of {} no one completed a trial.", who(summary));
  return fmt::format("Sorting: of {}, {}{}.", who(summary), text, verdicts_in_words(summary));
}

std::string comparison_sentence(const Summary& summary) {
  std::string known, unknown;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "threshold_75")) {
    const std::string where = fmt::format("{:g} g in {}", *one->reference_g, one->condition);
    if (one->value)
      known += fmt::format("{}{:.0f} g [{:.0f}, {:.0f}] at {}", known.empty() ? "" : ", ",
                           *one->value, *one->low, *one->high, where);
    else
      unknown += fmt::format("{}{}", unknown.empty() ? "" : ", ", where);
  }
  std::string text = "Comparisons: ";
  if (!known.empty())
    text +=
        fmt::format("75 %-correct discrimination threshold of the median participant {}", known);
  if (!unknown.empty())
    text += fmt::format("{}no threshold is identifiable at {}", known.empty() ? "" : "; ", unknown);
  return text + ".";
}

std::string estimation_sentence(const Summary& summary) {
  std::string text;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "estimation_exponent")) {
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ",
                        one->value ? fmt::format("{:.2f}", *one->value) : "none", one->condition);
    if (one->low) text += fmt::format(" [{:.2f}, {:.2f}]", *one->low, *one->high);
  }
  return fmt::format(
      "Magnitude estimation: exponent of the numbers over the masses {}; 1 is proportional.", text);
}

std::string limits_sentence(const Summary& summary) {
  std::string open;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.verdict == HypothesisVerdict::not_judged && !hypothesis.condition.empty())
      open += (open.empty() ? "" : ", ") + hypothesis.name;
  std::string text =
      summary.plan ? "What they can't say: what the protocol did not declare is exploratory"
                   : "What they can't say: no analysis was declared beforehand, so all of it is "
                     "exploratory";
  if (summary.simulated())
    text += summary.data == "simulated"
                ? "; a model answered, so nothing of this is about people"
                : "; a model answered a part of it, so it is not about people alone";
  if (find_estimate(summary.estimates, "jnd"))
    text +=
        "; the paper's JND follows the criterion and the start, so it is no measure of what "
        "people perceive";
  if (!open.empty()) text += fmt::format("; {} are inconclusive", open);
  return text + ".";
}
}  // namespace

std::vector<std::string> leading_sentences(const Summary& summary) {
  std::vector<std::string> sentences;
  if (find_estimate(summary.estimates, "sorting_answers"))
    sentences.push_back(sorting_sentence(summary));
  if (find_estimate(summary.estimates, "threshold_75"))
    sentences.push_back(comparison_sentence(summary));
  if (find_estimate(summary.estimates, "estimation_exponent"))
    sentences.push_back(estimation_sentence(summary));
  sentences.push_back(limits_sentence(summary));
  return sentences;
}

}  // namespace heft
