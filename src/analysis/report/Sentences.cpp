// The sentences on top of a report: what each section says, and what limits all of it.
#include <fmt/format.h>

#include "analysis/measures/Section.h"
#include "analysis/report/Notes.h"

namespace heft {

namespace {
const Hypothesis& named(const Summary& summary, std::string_view name) {
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.name == name) return hypothesis;
  return summary.hypotheses.front();
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

std::string participants_in_words(const Summary& summary) {
  const std::string people = fmt::format("{} {}participant{}", summary.n_participants,
                                         summary.data == "simulated" ? "simulated " : "",
                                         summary.n_participants == 1 ? "" : "s");
  return summary.data == "human and simulated" ? people + " (persons and models mixed)" : people;
}

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

std::vector<std::string> leading_sentences(const Summary& summary) {
  std::vector<std::string> sentences;
  for (const auto& section : summary.sections)
    if (std::string sentence = section->sentence(summary); !sentence.empty())
      sentences.push_back(std::move(sentence));
  sentences.push_back(limits_sentence(summary));
  return sentences;
}

}  // namespace heft
