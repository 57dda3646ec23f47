#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/display/Phrases.h"
#include "analysis/report/Notes.h"
#include "inference/MixedIndecision.h"

namespace heft {

namespace {
// From 1000 on without decimals, which no study supports.
std::string one_decimal(double value) {
  return std::abs(value) < 1000 ? fmt::format("{:.1f}", value) : in_grams(value);
}

std::string beside(const StudyEstimate& one, std::string_view unit) {
  return one.published ? fmt::format("; published {:.1f}{}", one.published->value, unit) : "";
}

std::string within(const StudyEstimate& one) {
  return one.low ? fmt::format(" [{}, {}]", one_decimal(*one.low), one_decimal(*one.high)) : "";
}

std::string share_figure(std::string_view what, const StudyEstimate& share) {
  if (!share.value) return fmt::format("{}: no trials", what);
  return fmt::format("{}: {:.1f} %{}, n = {}{}", what, *share.value, within(share), share.n,
                     beside(share, " %"));
}

std::string chance_figure(const Summary& summary, const std::string& condition) {
  const Estimates& all = summary.estimates;
  const StudyEstimate& chance = *find_estimate(all, "sorting_chance", {{"condition", condition}});
  if (!chance.value) return "a random order: no trials to be right in";
  std::string figure = fmt::format("a random order is right in {:.1f} % of trials", *chance.value);
  const auto by_cubes = estimates_of(all, "sorting_chance_by_cubes", {{"condition", condition}});
  if (by_cubes.size() == 1) return figure;
  std::string parts;
  for (const StudyEstimate* one : by_cubes)
    parts += fmt::format("{}{:.1f} % of {} trials with {} cubes", parts.empty() ? "" : ", ",
                         *one->value, one->n_trials, one->text_at("n_cubes"));
  return fmt::format("{}: {}", figure, parts);
}

std::string first_try_figure(const StudyEstimate& first_try) {
  return fmt::format("introduction right on the first try: {} of {} participants, {:.1f} %{}{}",
                     first_try.n_hits, first_try.n_trials, *first_try.value, within(first_try),
                     beside(first_try, " %"));
}

// JNDs that the paper has figures for.
std::vector<const StudyEstimate*> jnds_of(const Summary& summary) {
  auto jnds = estimates_of(summary.estimates, "jnd");
  std::erase_if(jnds, [](const StudyEstimate* one) { return !one->published || !one->value; });
  return jnds;
}

std::string_view began(const StudyEstimate& jnd) {
  return jnd.text_at("staircases") == "from above" ? " (staircases from above)" : "";
}

// The paper gives arithmetic means, so this is what its figure is to be compared with.
std::optional<double> arithmetic_mean_g(const Summary& summary, const StudyEstimate& jnd) {
  const StudyEstimate* mean = find_estimate(summary.estimates, "jnd_paper_mean",
                                            {{"staircases", jnd.text_at("staircases")},
                                             {"condition", jnd.condition},
                                             {"reference_g", jnd.text_at("reference_g")},
                                             {"method", jnd.text_at("method")}});
  return mean ? mean->value : std::nullopt;
}

// "; arithmetic mean 92.1, published 91.1"
std::string beside_paper(const std::optional<double>& mean, double published, int decimals) {
  const std::string own = mean
                              ? fmt::format("arithmetic mean {}, ",
                                            decimals == 1 ? one_decimal(*mean)
                                                          : fmt::format("{:.{}f}", *mean, decimals))
                              : "";
  return fmt::format("; {}published {:.{}f}", own, published, decimals);
}

constexpr std::string_view no_staircase = "no JND by the paper's rule in the paper's technique";

std::vector<std::string> jnd_figures(const Summary& summary) {
  std::vector<std::string> figures;
  for (const StudyEstimate* jnd : jnds_of(summary))
    figures.push_back(
        fmt::format("JND{} at {:g} g: {} g{}, n = {}{} g", began(*jnd), *jnd->reference_g,
                    one_decimal(*jnd->value), within(*jnd), jnd->n,
                    beside_paper(arithmetic_mean_g(summary, *jnd), jnd->published->value, 1)));
  if (figures.empty()) figures.emplace_back(no_staircase);
  const StudyEstimate* rising = find_estimate(summary.estimates, "jnd_rising");
  figures.push_back(rising ? fmt::format("JND rises from each reference to the next in {} of {} "
                                         "participants with all of them",
                                         rising->n_hits, rising->n_trials)
                           : "rising JNDs need two references or more");
  return figures;
}

std::vector<std::string> ratio_figures(const Summary& summary) {
  std::vector<std::string> figures;
  for (const StudyEstimate* jnd : jnds_of(summary)) {
    const double reference_g = *jnd->reference_g;
    if (reference_g == 0) continue;
    const std::string interval =
        jnd->low
            ? fmt::format(" [{:.2f}, {:.2f}]", *jnd->low / reference_g, *jnd->high / reference_g)
            : "";
    std::optional<double> mean = arithmetic_mean_g(summary, *jnd);
    if (mean) *mean /= reference_g;
    figures.push_back(fmt::format("JND{} / reference at {:g} g: {:.2f}{}{}", began(*jnd),
                                  reference_g, *jnd->value / reference_g, interval,
                                  beside_paper(mean, jnd->published->value / reference_g, 2)));
  }
  if (figures.empty()) figures.emplace_back(no_staircase);
  return figures;
}

struct Judgment {
  HypothesisVerdict verdict = HypothesisVerdict::inconclusive;
  std::string why;
};

constexpr double usual_margin_percent = 10;  // smaller differences from chance count as none

// "Blind" by two one-sided tests (Schuirmann 1987): the 90 % interval within chance +- 10 points.
Judgment judge_blind(const StudyEstimate& answered_correct, double chance, double margin_percent) {
  if (answered_correct.n < 2)
    return {
        HypothesisVerdict::inconclusive,
        fmt::format("fewer than two participants answered a {} trial", answered_correct.condition)};
  const double low = *answered_correct.low, high = *answered_correct.high;
  const Interval blind{chance - margin_percent, chance + margin_percent};
  const std::string figures = fmt::format(
      "of the answered trials {:.1f} % were right, 90 % interval [{:.1f}, {:.1f}]; chance is "
      "{:.1f} %, and [{:.1f}, {:.1f}] counts as chance",
      *answered_correct.value, low, high, chance, blind.low, blind.high);
  if (low >= blind.low && high <= blind.high)
    return {HypothesisVerdict::supported, figures + ": equivalent to chance"};
  if (high < blind.low || low > blind.high)
    return {HypothesisVerdict::not_supported, figures + ": not chance"};
  return {HypothesisVerdict::inconclusive, figures + ": the interval is too wide"};
}

Judgment judge_above_chance(const StudyEstimate& correct, double chance) {
  if (correct.n < 2)
    return {HypothesisVerdict::inconclusive,
            fmt::format("fewer than two participants completed a {} trial", correct.condition)};
  const std::string figures = fmt::format(
      "{:.1f} % of the trials were right, 95 % interval [{:.1f}, {:.1f}]; chance is "
      "{:.1f} %",
      *correct.value, *correct.low, *correct.high, chance);
  if (*correct.low > chance) return {HypothesisVerdict::supported, figures};
  if (*correct.high <= chance + usual_margin_percent)
    return {HypothesisVerdict::not_supported, figures};
  return {HypothesisVerdict::inconclusive,
          figures + ": the interval contains chance and much more"};
}

Judgment judge_first_try(const StudyEstimate& first_try) {
  if (first_try.n < 2)
    return {HypothesisVerdict::inconclusive,
            "fewer than two participants completed the introduction"};
  const std::string figures = fmt::format(
      "{} of {} participants were right on the first try, 95 % interval [{:.1f}, {:.1f}] %; "
      "guessing between two cubes makes 50 %",
      first_try.n_hits, first_try.n_trials, *first_try.low, *first_try.high);
  if (*first_try.low > 50) return {HypothesisVerdict::supported, figures};
  if (*first_try.high < 50) return {HypothesisVerdict::not_supported, figures};
  return {HypothesisVerdict::inconclusive, figures};
}

// Estimates in the paper's technique and at its references.
std::vector<const StudyEstimate*> papers(const Summary& summary, std::string_view measure) {
  auto rows = estimates_of(summary.estimates, measure);
  std::erase_if(rows, [](const StudyEstimate* one) { return !one->as_published; });
  return rows;
}

// Why thresholds can't be compared; empty: they can. The JND itself is no ground: it follows the
// criterion and the start of its staircase, and coin flips make it grow with the reference too.
std::string why_not_comparable(const std::vector<const StudyEstimate*>& thresholds) {
  if (thresholds.size() < 2)
    return "it takes comparisons at two of the paper's references or more in its technique";
  std::string why;
  for (const StudyEstimate* one : thresholds)
    if (!one->why.empty())
      why += fmt::format("{}at {:g} g there is no threshold ({})", why.empty() ? "" : "; ",
                         *one->reference_g, one->why);
  if (why.empty() && thresholds.front()->n < least_people)
    why = "there are too few participants to estimate how people differ";
  return why;
}

std::string threshold_figures(const std::vector<const StudyEstimate*>& thresholds) {
  std::string text = "75 % thresholds";
  for (const StudyEstimate* one : thresholds)
    text += fmt::format("{} {} g{} at {:g} g", one == thresholds.front() ? "" : ",",
                        one_decimal(*one->value), within(*one), *one->reference_g);
  return text;
}

// The exponent of thresholds that are comparable with the paper's.
const StudyEstimate& exponent_of(const Summary& summary) {
  return *papers(summary, "threshold_exponent").front();
}

std::string exponent_figure(const StudyEstimate& exponent) {
  return fmt::format("threshold ~ reference^{:.2f} [{:.2f}, {:.2f}]", *exponent.value,
                     *exponent.low, *exponent.high);
}

// An ordered trend: log threshold on log reference, over participants.
Judgment judge_rising(const Summary& summary) {
  const auto thresholds = papers(summary, "threshold_75");
  if (const std::string why = why_not_comparable(thresholds); !why.empty())
    return {HypothesisVerdict::inconclusive, why};
  const StudyEstimate& exponent = exponent_of(summary);
  const std::string figures = fmt::format(
      "{}; {}; a study of this size and spread finds exponents of {:.2f} or more in 80 % of cases",
      threshold_figures(thresholds), exponent_figure(exponent),
      *papers(summary, "smallest_threshold_exponent").front()->value);
  if (*exponent.low > 0) return {HypothesisVerdict::supported, figures + ": they increase"};
  if (*exponent.high < 0) return {HypothesisVerdict::not_supported, figures + ": they decrease"};
  return {HypothesisVerdict::inconclusive, figures + ": the interval contains 0"};
}

// Proportional: the exponent is 1, with a margin of a factor of 1.5 from one reference to the next.
Judgment judge_proportional(const Summary& summary) {
  const auto thresholds = papers(summary, "threshold_75");
  if (const std::string why = why_not_comparable(thresholds); !why.empty())
    return {HypothesisVerdict::inconclusive, why};
  const StudyEstimate& exponent = exponent_of(summary);
  const double steps = static_cast<double>(thresholds.size()) - 1;
  const double mean_step =
      std::log(*thresholds.back()->reference_g / *thresholds.front()->reference_g) / steps;
  const double margin = std::log(1.5) / mean_step;
  const std::string figures = fmt::format(
      "{}; {}; exponents in [{:.2f}, {:.2f}] are within a factor of 1.5 from each "
      "reference to the next",
      threshold_figures(thresholds), exponent_figure(exponent), 1 - margin, 1 + margin);
  if (*exponent.low >= 1 - margin && *exponent.high <= 1 + margin)
    return {HypothesisVerdict::supported, figures + ": proportional"};
  if (*exponent.low > 1 || *exponent.high < 1)
    return {HypothesisVerdict::not_supported, figures + ": the interval does not contain 1"};
  return {HypothesisVerdict::inconclusive, figures + ": the interval is too wide"};
}

Judgment not_run(const Summary& summary, std::string_view what) {
  if (summary.n_participants == 0)
    return {HypothesisVerdict::not_tested, "no participant is left after exclusions"};
  return {
      HypothesisVerdict::not_tested,
      fmt::format("no completed {} the paper's masses and technique, by law and parameters", what)};
}

Hypothesis judged(std::size_t index, Judgment judgment, std::vector<std::string> figures,
                  std::string condition) {
  const published::HypothesisText& text = published::hypotheses.at(index);
  return {std::string(text.name), std::string(text.statement), false,
          judgment.verdict,       std::move(judgment.why),     std::move(figures),
          std::move(condition)};
}

// Sorting in one of the paper's conditions, whatever its name in this protocol.
struct PaperSorting {
  PaperSorting(const Summary& summary, const published::Sorting& paper) : summary_(summary) {
    for (const StudyEstimate* one : estimates_of(summary.estimates, "sorting_answers"))
      if (one->published == &paper.correct) condition = one->condition;
    if (condition.empty()) return;
    chance = *estimate("sorting_chance", "all", "correct").value;
    chance_text = chance_figure(summary, condition);
  }
  const StudyEstimate& estimate(std::string_view measure, std::string_view trials,
                                std::string_view answer) const {
    return *find_estimate(summary_.estimates, measure,
                          {{"condition", condition}, {"trials", trials}, {"answer", answer}});
  }
  const StudyEstimate& share(std::string_view trials, std::string_view answer) const {
    return estimate("sorting_answers", trials, answer);
  }
  std::string none_figure() const {
    return share_figure(condition + " \"I don't know\", a separate outcome",
                        share("all", "I don't know"));
  }

  std::string condition;  // empty: no completed trial was in it with its masses
  std::string chance_text;
  double chance = 0;

 private:
  const Summary& summary_;
};

Hypothesis judged_of_control(const Summary& summary) {
  const PaperSorting control(summary, published::sorting_coupled);
  const std::string& name = control.condition;
  if (name.empty()) return judged(0, not_run(summary, "sorting of"), {}, "");
  return judged(
      0,
      judge_blind(control.estimate("sorting_equivalence", "answered", "correct"), control.chance,
                  equivalence_margin_percent(summary)),
      {share_figure(name + " correct", control.share("all", "correct")),
       share_figure(name + " correct, of answered trials", control.share("answered", "correct")),
       control.none_figure(), control.chance_text},
      name);
}

Hypothesis judged_of_technique(const Summary& summary) {
  const PaperSorting technique(summary, published::sorting_decoupled);
  const std::string& name = technique.condition;
  if (name.empty()) return judged(1, not_run(summary, "sorting of"), {}, "");
  const StudyEstimate& correct = technique.share("all", "correct");
  return judged(
      1, judge_above_chance(correct, technique.chance),
      {share_figure(name + " correct", correct), technique.none_figure(), technique.chance_text},
      name);
}

Hypothesis judged_of_introduction(const Summary& summary) {
  const StudyEstimate* first_try = find_estimate(summary.estimates, "introduction_first_try");
  if (!first_try || !first_try->published)
    return judged(2, not_run(summary, "introduction with"), {}, "");
  return judged(2, judge_first_try(*first_try), {first_try_figure(*first_try)},
                first_try->condition);
}

std::vector<Hypothesis> judged_of_jnds(const Summary& summary) {
  const auto thresholds = papers(summary, "threshold_75");
  if (thresholds.empty())
    return {judged(3, not_run(summary, "comparison with"), {}, ""),
            judged(4, not_run(summary, "comparison with"), {}, "")};
  const std::string& condition = thresholds.front()->condition;
  return {judged(3, judge_rising(summary), jnd_figures(summary), condition),
          judged(4, judge_proportional(summary), ratio_figures(summary), condition)};
}
}  // namespace

std::vector<Hypothesis> hypotheses_of(const Summary& summary) {
  std::vector<Hypothesis> all{judged_of_control(summary), judged_of_technique(summary),
                              judged_of_introduction(summary)};
  for (Hypothesis& hypothesis : judged_of_jnds(summary)) all.push_back(std::move(hypothesis));
  for (Hypothesis& hypothesis : all)
    hypothesis.declared = summary.plan && summary.plan->declares(hypothesis.name);
  return all;
}

}  // namespace heft
