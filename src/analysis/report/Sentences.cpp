// The findings and their limits as sentences, for the first screen and the top of the report.
#include <fmt/format.h>

#include <cctype>

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
  std::string text = summary.plan
                         ? "Limits: results that the protocol did not declare are exploratory"
                         : "Limits: no analysis was declared beforehand, so all results are "
                           "exploratory";
  if (summary.simulated())
    text += summary.data == "simulated" ? "; a model answered, so nothing here is about people"
                                        : "; a model gave some of the answers";
  if (find_estimate(summary.estimates, "jnd", {{"method", std::string(jnd_method)}}))
    text +=
        "; the paper's JND depends on the criterion and on the start of the staircase, so it does "
        "not measure perception alone";
  return text + ".";
}

// Empty: inconclusive, or not run.
std::string technique_verdict(const Hypothesis& works) {
  if (works.verdict == HypothesisVerdict::supported)
    return fmt::format("masses are discriminated in {}", works.condition);
  if (works.verdict == HypothesisVerdict::not_supported)
    return fmt::format(
        "masses are hardly or not discriminated in {} (at most 10 points above chance)",
        works.condition);
  return "";
}

std::string control_verdict(const Hypothesis& blind, double margin_percent) {
  if (blind.verdict == HypothesisVerdict::supported)
    return fmt::format("answers in {} are equivalent to chance (within {:g} points)",
                       blind.condition, margin_percent);
  if (blind.verdict == HypothesisVerdict::not_supported)
    return fmt::format("answers in {} differ from chance", blind.condition);
  return "";
}

// "6 of 6 participants have none: all answers are the same: ..." as "all answers are the same".
std::string short_reason(const std::string& why) {
  constexpr std::string_view before = "none: ";
  const std::size_t found = why.find(before);
  const std::size_t begin = found == std::string::npos ? 0 : found + before.size();
  return why.substr(begin, why.find_first_of(":,", begin) - begin);
}
}  // namespace

std::string in_condition(const Summary& summary, const std::string& condition) {
  const auto found = summary.comparable.find(condition);
  const auto papers = found == summary.comparable.end() ? std::nullopt : found->second.condition();
  return papers ? fmt::format("{} ({})", published::in_words(*papers), condition)
                : "in " + condition;
}

std::vector<std::string> threshold_findings(const Summary& summary, std::string_view task,
                                            std::string_view measure) {
  std::vector<std::string> parts;
  for (const StudyEstimate* one : estimates_of(summary.estimates, measure)) {
    std::string part = one->value ? fmt::format("{:.0f} g", *one->value) : "not identifiable";
    if (one->value && one->low && one->high)
      part += fmt::format(" [{:.0f}, {:.0f}]", *one->low, *one->high);
    part += fmt::format(" at {:g} g {}", *one->reference_g, in_condition(summary, one->condition));
    if (one->value && !one->why.empty())
      part += fmt::format(", over the {} that can be estimated", counted(one->n, "participant"));
    if (!one->value && !one->why.empty()) part += fmt::format(" ({})", short_reason(one->why));
    parts.push_back(part);
  }
  if (parts.empty()) return {};
  return {fmt::format("{}: the 75 % threshold is {}.", task, some_of(parts, 4))};
}

std::string sorting_verdicts(const Summary& summary) {
  std::vector<std::string> verdicts{
      technique_verdict(named(summary, "E1-H2")),
      control_verdict(named(summary, "E1-H1"), equivalence_margin_percent(summary))};
  std::erase(verdicts, "");
  if (verdicts.empty()) return "";
  std::string text = fmt::format("{}.", fmt::join(verdicts, "; "));
  text[0] = static_cast<char>(std::toupper(text[0]));
  return text;
}

std::string inconclusive_sentence(const Summary& summary) {
  std::vector<std::string> open;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.verdict == HypothesisVerdict::inconclusive && !hypothesis.condition.empty())
      open.push_back(hypothesis.name);
  if (open.empty()) return "";
  return fmt::format("Inconclusive: hypothes{} {} of the paper.", open.size() == 1 ? "is" : "es",
                     fmt::join(open, ", "));
}

std::vector<std::string> findings_of(const Summary& summary) {
  std::vector<std::string> findings;
  for (const auto& section : summary.sections)
    for (std::string& finding : section->findings(summary))
      if (!finding.empty()) findings.push_back(std::move(finding));
  return findings;
}

std::vector<std::string> leading_sentences(const Summary& summary) {
  std::vector<std::string> sentences = findings_of(summary);
  sentences.push_back(inconclusive_sentence(summary));
  sentences.push_back(limits_sentence(summary));
  std::erase(sentences, "");
  return sentences;
}

}  // namespace heft
