// The rival models and the paper's figures.
#include "results/paper/PaperStudy.h"

namespace heft {

namespace {
constexpr double ceiling_g = 1500;  // of protocols/paper.toml's levels

// What a criterion on millimeters has: its median and spread, and the noise of the comparison.
std::vector<RivalParameter> criterion_and(RivalParameter noise) {
  return {{{"criterion_mm", 1, 60}},
          {{"criterion_mm.spread", 0.1, 1.2}},
          std::move(noise),
          {{"guess_probability", 0.3, 0.95}, true, false}};
}

std::string short_name(const FigurePlace& place, bool is_sd) {
  return (is_sd ? "SD of " : "") + text_of(place);
}
}  // namespace

std::vector<Rival> rivals() {
  using enum RivalGroup;
  const RivalParameter judgment{{"judgment_noise_mm", 0.5, 40}};
  const RivalParameter p{{"p", 0.05, 0.95}};
  std::vector<RivalParameter> adaptive = criterion_and(judgment), fused = criterion_and(judgment);
  adaptive.push_back({{"stop_gap_m", 0.015, 0.12}});
  fused[2] = {{"haptic_noise_mm", 1, 60}};
  return {
      {"offset", mechanism, "simulated", "", criterion_and(judgment)},
      {"offset with adaptive depth", mechanism, "simulated", "adaptive.toml", adaptive},
      {"control/display ratio", mechanism, "simulated", "ratio.toml", criterion_and(judgment)},
      {"offset fused with felt weight", mechanism, "simulated", "fused.toml", fused},
      {"moved or not",
       null,
       "simulated",
       "moved.toml",
       {{{"just_visible_mm", 1, 20}},
        {{"stroke_length_m", 0.04, 0.18}},
        {{"stroke_length_m.spread", 0.05, 0.6}},
        {{"guess_probability", 0.3, 0.95}, true, false}}},
      {"proportional Weber",
       null,
       "weber",
       "",
       {{{"weber_fraction", 0.1, 15}},
        {{"weber_fraction.spread", 0.1, 1.2}},
        {{"weber_noise", 0.05, 2.5}}}},
      {"start-anchored",
       null,
       "start_anchored",
       "",
       {{{"anchor_fraction", 0.2, 2.5}, false, true},
        {{"anchor_fraction.spread", 0.1, 1.2}, false, true},
        {{"anchor_noise", 0.05, 2}, false, true},
        {p.parameter, true, false}}},
      {"criterion only", null, "criterion_only", "", criterion_and(judgment)},
      {"beta coin", null, "coin", "", {p, {{"concentration", 0.3, 300}}}},
      {"coin", null, "coin", "", {p}},
      {"ideal observer", bound, "ideal", "", {}},
  };
}

std::vector<PaperFigure> paper_figures(const std::vector<ReportedFigure>& reported) {
  std::vector<PaperFigure> figures;
  for (std::size_t i = 0; i < reported.size(); ++i) {
    const FigurePlace& place = reported[i].place;
    if (!reported[i].mean) continue;
    const bool is_jnd = place.kind == FigureKind::jnd;
    PaperFigure figure{i, short_name(place, false), false, *reported[i].mean};
    figure.experiment = is_jnd ? PaperExperiment::jnd : PaperExperiment::sorting;
    figure.range = is_jnd ? ceiling_g : 100;
    // The shares of correct, incorrect and "don't know" add up to 100 %.
    figure.independent = !(place.kind == FigureKind::dont_know && place.condition == "C1") &&
                         !(place.kind == FigureKind::incorrect && place.condition == "C2");
    figures.push_back(figure);
    if (!reported[i].sd) continue;
    figure.name = short_name(place, true);
    figure.is_sd = true;
    figure.value = *reported[i].sd;
    figure.range /= 2;
    figures.push_back(figure);
  }
  return figures;
}

RivalResult::Total RivalResult::total(const std::vector<PaperFigure>& figures_of_paper,
                                      PaperExperiment experiment) const {
  Total total;
  for (std::size_t f = 0; f < figures_of_paper.size(); ++f) {
    if (figures_of_paper[f].experiment != experiment) continue;
    ++total.n;
    total.n_hits += figures[f].hit ? 1 : 0;
    if (figures_of_paper[f].independent) total.log_score += figures[f].log_score;
  }
  return total;
}

}  // namespace heft
