#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "analysis/Notes.h"

namespace heft {

namespace {
std::string beside(const published::Figure* figure, std::string_view unit) {
  return figure ? fmt::format("; published {:.1f}{}", figure->value, unit) : "";
}

std::string within(const std::optional<Interval>& interval) {
  return interval ? fmt::format(" [{:.1f}, {:.1f}]", interval->low, interval->high) : "";
}

std::string proportion_figure(std::string_view what, const Proportion& proportion,
                              const published::Figure* figure) {
  if (!proportion.mean_percent) return fmt::format("{}: no trials", what);
  return fmt::format("{}: {:.1f} %{}, n = {}{}", what, *proportion.mean_percent,
                     within(proportion.interval_percent), proportion.n_participants,
                     beside(figure, " %"));
}

std::string chance_figure(const ConditionSorting& sorting) {
  const auto& by_cubes = sorting.n_trials_by_cubes;
  if (by_cubes.empty()) return "a random order: no trials to be right in";
  std::string figure =
      fmt::format("a random order is right in {:.1f} % of trials", *sorting.chance_percent());
  if (by_cubes.size() == 1) return figure;
  std::string parts;
  for (const auto& [n_cubes, n_trials] : by_cubes)
    parts += fmt::format("{}{:.1f} % of {} trials with {} cubes", parts.empty() ? "" : ", ",
                         chance_percent(n_cubes), n_trials, n_cubes);
  return fmt::format("{}: {}", figure, parts);
}

std::string first_try_figure(const IntroductionSummary& introduction) {
  const Rate& rate = introduction.first_try;
  if (!rate.percent) return "introduction: not completed by anyone";
  return fmt::format("introduction right on the first try: {} of {} participants, {:.1f} %{}{}",
                     rate.trials.n_hits, rate.trials.n_trials, *rate.percent,
                     within(rate.interval_percent), beside(introduction.published, " %"));
}

bool counts(const ReferenceJnd& jnd) {
  return jnd.published && jnd.as_published().mean.has_value();
}

std::string_view began(const ReferenceJnd& jnd) {
  return jnd.starts ? " (staircases from above)" : "";
}

std::vector<std::string> jnd_figures(const Summary& summary) {
  std::vector<std::string> figures;
  for (const ReferenceJnd& jnd : summary.jnd)
    if (counts(jnd))
      figures.push_back(fmt::format("JND{} at {:g} g: {:.1f} g{}, n = {}{}", began(jnd),
                                    jnd.compared.reference_g, *jnd.as_published().mean,
                                    within(jnd.as_published().interval), jnd.n(),
                                    beside(jnd.published, " g")));
  if (figures.empty()) figures.push_back("no finished staircase in the paper's technique");
  return figures;
}

// Of the participants with a JND at every reference, those whose JND rises at each step.
std::string rising_figure(const Summary& summary) {
  std::map<std::string, std::vector<double>> jnds;
  std::size_t n_references = 0;
  for (const ReferenceJnd& jnd : summary.jnd) {
    if (!counts(jnd)) continue;
    ++n_references;
    const StartedJnds as_published = jnd.as_published();
    for (const ParticipantJnd& one : as_published.participants)
      if (one.censored == Censored::none) jnds[one.participant].push_back(one.jnd_g);
  }
  int n_complete = 0, n_rising = 0;
  for (const auto& [participant, values] : jnds) {
    if (values.size() != n_references) continue;
    ++n_complete;
    bool rising = true;
    for (std::size_t i = 1; i < values.size(); ++i) rising = rising && values[i - 1] < values[i];
    n_rising += rising ? 1 : 0;
  }
  return n_references < 2 ? "rising JNDs need two references or more"
                          : fmt::format(
                                "JND rises from each reference to the next in {} of {} "
                                "participants with all of them",
                                n_rising, n_complete);
}

std::vector<std::string> ratio_figures(const Summary& summary) {
  std::vector<std::string> figures;
  for (const ReferenceJnd& jnd : summary.jnd) {
    const double reference_g = jnd.compared.reference_g;
    if (!counts(jnd) || reference_g == 0) continue;
    const std::string published =
        fmt::format("; published {:.2f}", jnd.published->value / reference_g);
    const StartedJnds jnds = jnd.as_published();
    const std::string interval =
        jnds.interval ? fmt::format(" [{:.2f}, {:.2f}]", jnds.interval->low / reference_g,
                                    jnds.interval->high / reference_g)
                      : "";
    figures.push_back(fmt::format("JND{} / reference at {:g} g: {:.2f}{}{}", began(jnd),
                                  reference_g, *jnds.mean / reference_g, interval, published));
  }
  if (figures.empty()) figures.push_back("no finished staircase in the paper's technique");
  return figures;
}

struct Judgment {
  HypothesisVerdict verdict = HypothesisVerdict::not_judged;
  std::string why;
};

constexpr double usual_margin_percent = 10;  // beside chance: what counts as no better

// "Blind" by two one-sided tests (Schuirmann 1987): the 90 % interval within chance +- 10 points.
Judgment judge_blind(const ConditionSorting& control, double margin_percent) {
  const Proportion& correct = control.answered_correct;
  if (correct.n_participants < 2 || !control.answered_correct_90_percent)
    return {HypothesisVerdict::not_judged,
            fmt::format("fewer than two participants answered a {} trial", control.condition)};
  const double chance = *control.chance_percent();
  const Interval& interval = *control.answered_correct_90_percent;
  const Interval blind{chance - margin_percent, chance + margin_percent};
  const std::string figures = fmt::format(
      "of the answered trials {:.1f} % were right, 90 % interval [{:.1f}, {:.1f}]; chance is "
      "{:.1f} %, and [{:.1f}, {:.1f}] counts as chance",
      *correct.mean_percent, interval.low, interval.high, chance, blind.low, blind.high);
  if (interval.low >= blind.low && interval.high <= blind.high)
    return {HypothesisVerdict::supported, figures + ": equivalent to chance"};
  if (interval.high < blind.low || interval.low > blind.high)
    return {HypothesisVerdict::not_supported, figures + ": not chance"};
  return {HypothesisVerdict::not_judged,
          figures + ": too wide to say that it is chance, or that it is not"};
}

Judgment judge_above_chance(const ConditionSorting& technique) {
  const Proportion& correct = technique.correct;
  if (correct.n_participants < 2)
    return {HypothesisVerdict::not_judged,
            fmt::format("fewer than two participants completed a {} trial", technique.condition)};
  const double chance = *technique.chance_percent();
  const Interval& interval = *correct.interval_percent;
  const std::string figures = fmt::format(
      "{:.1f} % of the trials were right, 95 % interval [{:.1f}, {:.1f}]; chance is "
      "{:.1f} %",
      *correct.mean_percent, interval.low, interval.high, chance);
  if (interval.low > chance) return {HypothesisVerdict::supported, figures};
  if (interval.high <= chance + usual_margin_percent)
    return {HypothesisVerdict::not_supported, figures};
  return {HypothesisVerdict::not_judged, figures + ": the interval holds chance and much more"};
}

Judgment judge_first_try(const Rate& rate) {
  if (rate.trials.n_trials < 2)
    return {HypothesisVerdict::not_judged,
            "fewer than two participants completed the introduction"};
  const Interval& interval = *rate.interval_percent;
  const std::string figures = fmt::format(
      "{} of {} participants were right on the first try, 95 % interval [{:.1f}, {:.1f}] %; "
      "guessing between two cubes makes 50 %",
      rate.trials.n_hits, rate.trials.n_trials, interval.low, interval.high);
  if (interval.low > 50) return {HypothesisVerdict::supported, figures};
  if (interval.high < 50) return {HypothesisVerdict::not_supported, figures};
  return {HypothesisVerdict::not_judged, figures};
}

std::vector<const ReferenceSensitivity*> paper_sensitivities(const Summary& summary) {
  std::vector<const ReferenceSensitivity*> rows;
  for (const ReferenceSensitivity& row : summary.sensitivity)
    if (row.as_published) rows.push_back(&row);
  return rows;
}

// Why sensitivities can't be compared; empty: they can. The JND itself is no ground: it follows the
// criterion and the start of its staircase, and coin flips make it grow with the reference too.
std::string why_not_comparable(const std::vector<const ReferenceSensitivity*>& rows) {
  if (rows.size() < 2)
    return "it takes comparisons at two of the paper's references or more in its technique";
  std::string why;
  for (const ReferenceSensitivity* row : rows)
    if (!row->pooled.identifiable())
      why += fmt::format("{}at {:g} g there is no threshold, because {}", why.empty() ? "" : "; ",
                         row->compared.reference_g, row->pooled.why);
  if (why.empty() && rows.front()->pooled.n < least_people)
    why = "there are too few participants to tell how people differ";
  return why;
}

std::string threshold_figures(const std::vector<const ReferenceSensitivity*>& rows) {
  std::string text = "75 % thresholds";
  for (const ReferenceSensitivity* row : rows)
    text += fmt::format("{} {:.1f} g{} at {:g} g", row == rows.front() ? "" : ",",
                        *row->pooled.threshold_75_g, within(row->pooled.threshold_interval_g),
                        row->compared.reference_g);
  return text;
}

// Of each threshold to the one before.
std::vector<Interval> ratios_of(const std::vector<const ReferenceSensitivity*>& rows,
                                double confidence = confidence_level) {
  std::vector<Interval> ratios;
  for (std::size_t i = 1; i < rows.size(); ++i)
    ratios.push_back(threshold_ratio_interval(rows[i - 1]->pooled, rows[i]->pooled, confidence));
  return ratios;
}

// What one ratio of several is to show has more chances to come about by chance (Bonferroni).
std::vector<Interval> ratios_together(const std::vector<const ReferenceSensitivity*>& rows) {
  const double n = static_cast<double>(rows.size() - 1);
  return ratios_of(rows, 1 - (1 - confidence_level) / n);
}

Judgment judge_rising(const Summary& summary) {
  const auto rows = paper_sensitivities(summary);
  if (const std::string why = why_not_comparable(rows); !why.empty())
    return {HypothesisVerdict::not_judged, why};
  const std::string figures = threshold_figures(rows);
  const auto rises = [](const Interval& ratio) { return ratio.low > 1; };
  const auto falls = [](const Interval& ratio) { return ratio.high < 1; };
  if (std::ranges::all_of(ratios_of(rows), rises))
    return {HypothesisVerdict::supported, figures + ": each larger than the one before"};
  if (std::ranges::any_of(ratios_together(rows), falls))
    return {HypothesisVerdict::not_supported, figures + ": one is smaller than the one before"};
  return {HypothesisVerdict::not_judged, figures + ": their intervals don't tell which is larger"};
}

// Proportional: from each reference to the next the threshold grows as the reference does, within
// a factor of 1.5.
Judgment judge_proportional(const Summary& summary) {
  const auto rows = paper_sensitivities(summary);
  if (const std::string why = why_not_comparable(rows); !why.empty())
    return {HypothesisVerdict::not_judged, why};
  constexpr double near = 1.5;
  const std::string figures = threshold_figures(rows);
  const std::vector<Interval> ratios = ratios_of(rows), together = ratios_together(rows);
  bool all_near = true, any_off = false;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double expected = rows[i]->compared.reference_g / rows[i - 1]->compared.reference_g;
    const Interval &one = ratios[i - 1], &strict = together[i - 1];
    all_near = all_near && one.low >= expected / near && one.high <= expected * near;
    any_off = any_off || strict.low > expected || strict.high < expected;
  }
  if (all_near)
    return {HypothesisVerdict::supported, figures + ": in proportion within a factor of 1.5"};
  if (any_off)
    return {HypothesisVerdict::not_supported, figures + ": not in proportion to the reference"};
  return {HypothesisVerdict::not_judged, figures + ": too uncertain to say"};
}

// What the paper's condition was called here; null: no completed trial was in it with its masses.
const ConditionSorting* sorting_in(const Summary& summary, published::Condition condition) {
  const auto found = std::ranges::find(summary.sorting, condition, &ConditionSorting::published);
  return found == summary.sorting.end() ? nullptr : &*found;
}

Judgment not_run(std::string_view what) {
  return {
      HypothesisVerdict::not_judged,
      fmt::format("no completed {} the paper's masses and technique, by law and parameters", what)};
}

Hypothesis judged(std::size_t index, Judgment judgment, std::vector<std::string> figures,
                  std::string condition) {
  const published::HypothesisText& text = published::hypotheses.at(index);
  return {std::string(text.name), std::string(text.statement), false,
          judgment.verdict,       std::move(judgment.why),     std::move(figures),
          std::move(condition)};
}

Hypothesis judged_of_control(const Summary& summary) {
  const ConditionSorting* control = sorting_in(summary, published::Condition::coupled);
  if (!control) return judged(0, not_run("sorting of"), {}, "");
  const published::Sorting& paper = published::sorting_coupled;
  const std::string& name = control->condition;
  return judged(0, judge_blind(*control, equivalence_margin_percent(summary)),
                {proportion_figure(name + " correct", control->correct, &paper.correct),
                 proportion_figure(name + " correct, of answered trials", control->answered_correct,
                                   &*paper.answered_correct),
                 proportion_figure(name + " \"I don't know\", an outcome of its own", control->none,
                                   &paper.none),
                 chance_figure(*control)},
                name);
}

Hypothesis judged_of_technique(const Summary& summary) {
  const ConditionSorting* technique = sorting_in(summary, published::Condition::decoupled);
  if (!technique) return judged(1, not_run("sorting of"), {}, "");
  const published::Sorting& paper = published::sorting_decoupled;
  const std::string& name = technique->condition;
  return judged(1, judge_above_chance(*technique),
                {proportion_figure(name + " correct", technique->correct, &paper.correct),
                 proportion_figure(name + " \"I don't know\", an outcome of its own",
                                   technique->none, &paper.none),
                 chance_figure(*technique)},
                name);
}

Hypothesis judged_of_introduction(const Summary& summary) {
  const IntroductionSummary& introduction = summary.introduction;
  if (!introduction.published) return judged(2, not_run("introduction with"), {}, "");
  return judged(2, judge_first_try(introduction.first_try), {first_try_figure(introduction)},
                introduction.conditions);
}

std::vector<Hypothesis> judged_of_jnds(const Summary& summary) {
  const auto rows = paper_sensitivities(summary);
  if (rows.empty())
    return {judged(3, not_run("comparison with"), {}, ""),
            judged(4, not_run("comparison with"), {}, "")};
  const std::string& condition = rows.front()->compared.condition;
  std::vector<std::string> rising = jnd_figures(summary);
  rising.push_back(rising_figure(summary));
  return {judged(3, judge_rising(summary), rising, condition),
          judged(4, judge_proportional(summary), ratio_figures(summary), condition)};
}
}  // namespace

double equivalence_margin_percent(const Summary& summary) {
  return summary.plan ? summary.plan->equivalence_margin : usual_margin_percent;
}

std::vector<Hypothesis> hypotheses_of(const Summary& summary) {
  std::vector<Hypothesis> all{judged_of_control(summary), judged_of_technique(summary),
                              judged_of_introduction(summary)};
  for (Hypothesis& hypothesis : judged_of_jnds(summary)) all.push_back(std::move(hypothesis));
  for (Hypothesis& hypothesis : all)
    hypothesis.declared = summary.plan && summary.plan->declares(hypothesis.name);
  return all;
}

}  // namespace heft
