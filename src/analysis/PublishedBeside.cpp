#include "analysis/PublishedBeside.h"

#include <fmt/format.h>

#include "analysis/Published.h"

namespace heft {

namespace {
constexpr std::string_view of_sorting = "Experiment 1, Results and discussion, paragraph ";
constexpr std::string_view of_jnds = "Experiment 2, Results and discussion, list of means";

void add_proportion(std::vector<PublishedFigure>& all, const std::string& what, int paragraph,
                    const Proportion& proportion) {
  if (!proportion.published_percent) return;
  PublishedFigure figure{what, "%", fmt::format("{}{}", of_sorting, paragraph),
                         *proportion.published_percent, proportion.published_sd_percent};
  if (figure.published_sd)
    figure.published_interval =
        student_t_interval(figure.published, *figure.published_sd, published::n_participants);
  figure.found = proportion.mean_percent;
  figure.found_sd = proportion.sd_percent;
  figure.found_interval = proportion.interval_percent;
  figure.n = proportion.n_participants;
  all.push_back(std::move(figure));
}

void add_introduction(std::vector<PublishedFigure>& all, const IntroductionSummary& introduction) {
  if (!introduction.published_percent || !introduction.published_n) return;
  const Rate paper = rate_of_people({published::introduction_first_try, *introduction.published_n});
  const Rate& rate = introduction.first_try;
  all.push_back({"introduction, first try", "%", fmt::format("{}3", of_sorting), *paper.percent,
                 std::nullopt, paper.interval_percent, rate.percent, std::nullopt,
                 rate.interval_percent, rate.n_participants});
}

void add_jnd(std::vector<PublishedFigure>& all, const ReferenceJnd& jnd) {
  if (!jnd.published_g) return;
  const StartedJnds jnds = jnd.as_published();
  all.push_back(
      {fmt::format("JND at {:g} g{}", jnd.compared.reference_g, jnd.starts ? " (from above)" : ""),
       "g", std::string(of_jnds), *jnd.published_g, jnd.published_sd_g,
       student_t_interval(*jnd.published_g, *jnd.published_sd_g, published::n_participants),
       jnds.mean, jnds.sd, jnds.interval, jnds.n()});
}
}  // namespace

std::vector<PublishedFigure> published_beside(const Summary& summary) {
  std::vector<PublishedFigure> all;
  for (int i = 0; i < 2; ++i) {
    const ConditionSorting& sorting = summary.sorting.at(static_cast<std::size_t>(i));
    const auto add = [&](const char* what, const Proportion& proportion) {
      add_proportion(all, sorting.condition + " " + what, i + 1, proportion);
    };
    add("correct", sorting.correct);
    add("incorrect", sorting.incorrect);
    add("I don't know", sorting.none);
    add("correct of answered", sorting.answered_correct);
  }
  add_introduction(all, summary.introduction);
  for (const ReferenceJnd& jnd : summary.jnd) add_jnd(all, jnd);
  return all;
}

}  // namespace heft
