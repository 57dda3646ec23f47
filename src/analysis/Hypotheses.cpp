#include <fmt/format.h>

#include <map>
#include <string_view>

#include "analysis/Notes.h"

namespace heft {

namespace {
std::string beside(std::optional<double> published, std::string_view unit) {
  return published ? fmt::format("; published {:.1f}{}", *published, unit) : "";
}

std::string within(const std::optional<Interval>& interval) {
  return interval ? fmt::format(" [{:.1f}, {:.1f}]", interval->low, interval->high) : "";
}

std::string proportion_figure(std::string_view what, const Proportion& proportion) {
  if (!proportion.mean_percent) return fmt::format("{}: no trials", what);
  return fmt::format("{}: {:.1f} %{}, n = {}{}", what, *proportion.mean_percent,
                     within(proportion.interval_percent), proportion.n_participants,
                     beside(proportion.published_percent, " %"));
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
                     within(rate.interval_percent), beside(introduction.published_percent, " %"));
}

bool counts(const ReferenceJnd& jnd) {
  return jnd.compared.condition == "C2" && jnd.mean_g.has_value();
}

std::vector<std::string> jnd_figures(const Summary& summary) {
  std::vector<std::string> figures;
  for (const ReferenceJnd& jnd : summary.jnd)
    if (counts(jnd))
      figures.push_back(fmt::format("JND at {:g} g: {:.1f} g{}, n = {}{}", jnd.compared.reference_g,
                                    *jnd.mean_g, within(jnd.interval_g), jnd.n(),
                                    beside(jnd.published_g, " g")));
  if (figures.empty()) figures.push_back("no finished staircase in C2");
  return figures;
}

// Of the participants with a JND at every reference, those whose JND rises at each step.
std::string rising_figure(const Summary& summary) {
  std::map<std::string, std::vector<double>> jnds;
  std::size_t n_references = 0;
  for (const ReferenceJnd& jnd : summary.jnd) {
    if (!counts(jnd)) continue;
    ++n_references;
    for (const ParticipantJnd& one : jnd.participants)
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
        jnd.published_g ? fmt::format("; published {:.2f}", *jnd.published_g / reference_g) : "";
    figures.push_back(fmt::format("JND / reference at {:g} g: {:.2f}{}", reference_g,
                                  *jnd.mean_g / reference_g, published));
  }
  if (figures.empty()) figures.push_back("no finished staircase in C2");
  return figures;
}
}  // namespace

std::vector<Hypothesis> hypotheses_of(const Summary& summary) {
  const ConditionSorting &c1 = summary.sorting.at(0), &c2 = summary.sorting.at(1);
  std::vector<std::string> rising = jnd_figures(summary);
  rising.push_back(rising_figure(summary));
  return {{"E1-H1",
           "C1 does not allow to perceive a mass difference among virtual objects",
           {proportion_figure("C1 correct", c1.correct),
            proportion_figure("C1 correct, of answered trials", c1.answered_correct),
            proportion_figure("C1 \"I don't know\"", c1.none), chance_figure(c1)}},
          {"E1-H2",
           "C2 allows to recognize which objects are lighter and heavier",
           {proportion_figure("C2 correct", c2.correct),
            proportion_figure("C2 \"I don't know\"", c2.none), chance_figure(c2)}},
          {"E1-H3", "C2 is effective with no training", {first_try_figure(summary.introduction)}},
          {"E2-H1", "the JND increases with the reference mass", rising},
          {"E2-H2", "the JND is proportional to the reference mass", ratio_figures(summary)}};
}

}  // namespace heft
