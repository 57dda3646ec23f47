// The findings and their limits as sentences, for the first screen and the top of the report.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/measures/Section.h"
#include "analysis/report/Notes.h"

namespace heft {

namespace {
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
}  // namespace

std::string inconclusive_sentence(const Summary& summary) {
  std::vector<std::string> open, untested;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.applies()) {
      if (hypothesis.verdict == HypothesisVerdict::inconclusive) open.push_back(hypothesis.name);
      if (hypothesis.verdict == HypothesisVerdict::not_tested) untested.push_back(hypothesis.name);
    }
  std::string text;
  if (!open.empty())
    text = fmt::format("Inconclusive: hypothes{} {} of the paper.", open.size() == 1 ? "is" : "es",
                       fmt::join(open, ", "));
  if (!untested.empty())
    text += fmt::format("{}Declared but not tested, {}: {}.", text.empty() ? "" : " ",
                        summary.n_participants == 0
                            ? "because no participant is left"
                            : "without trials of the paper's masses and technique",
                        fmt::join(untested, ", "));
  return text;
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
  const auto has_brackets = [](const std::string& sentence) {
    return sentence.find('[') != std::string::npos;
  };
  if (std::ranges::any_of(sentences, has_brackets))
    sentences.emplace_back("Brackets are 95 % intervals.");
  sentences.push_back(limits_sentence(summary));
  std::erase(sentences, "");
  return sentences;
}

}  // namespace heft
