#include "analysis/display/Phrases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

namespace heft {

namespace {
const Hypothesis& named(const Summary& summary, std::string_view name) {
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.name == name) return hypothesis;
  return summary.hypotheses.front();
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

std::string titled(std::string_view title, const Summary& summary) {
  return titled(title, summary.simulated() ? summary.data : "", summary);
}

std::string titled(std::string_view title, const std::string& data, const Summary& summary) {
  const std::string marks = marked(data, summary);
  return marks.empty() ? std::string(title) : fmt::format("{} ({})", title, marks);
}

std::string marked(const std::string& data, const Summary& summary) {
  if (summary.integrity.is_verified) return data;
  return data + (data.empty() ? "" : ", ") + "NOT VERIFIED";
}

std::string in_digits(double value) {
  return std::abs(value) >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string in_grams(double value_g) {
  const double size_g = std::abs(value_g);
  if (size_g < 1000) return fmt::format("{:.0f}", value_g);
  const double unit_g = std::pow(10, std::floor(std::log10(size_g)) - 2);
  return fmt::format("{:.0f}", unit_g * std::round(value_g / unit_g));
}

std::string grams_between(const StudyEstimate& estimate) {
  if (!estimate.low || !estimate.high) return "";
  return fmt::format(" [{}, {}]", in_grams(*estimate.low), in_grams(*estimate.high));
}

std::string some_of(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = std::min(most, names.size());
  std::string text = fmt::format("{}", fmt::join(std::span(names).first(shown), ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

std::string simulated_note(const Summary& summary) {
  if (summary.data == "simulated") return "All figures are of simulated responders.";
  if (!summary.simulated()) return "";
  return "Figures of people and of simulated responders are mixed.";
}

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
    std::string part = one->value ? in_grams(*one->value) + " g" : "not identifiable";
    if (one->value) part += grams_between(*one);
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

double equivalence_margin_percent(const Summary& summary) {
  return summary.plan.value_or(AnalysisPlan{}).equivalence_margin;
}

}  // namespace heft
