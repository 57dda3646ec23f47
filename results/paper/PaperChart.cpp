// Tiles: which of the paper's figures each model hits.
#include <algorithm>
#include <map>

#include "analysis/charts/Plot.h"
#include "results/paper/PaperStudy.h"

namespace heft {

namespace {
constexpr int width_px = 1180, height_px = 640;
constexpr double panel_step = 20.5, gap = 0.6, label_gap = 0.7;
constexpr std::string_view fitted_hit = "#b9cfe4", predicted_hit = "#1f5fa8", miss = "#ffffff",
                           no_fit_hit = "#8a94a0";

PaperExperiment other_than(PaperExperiment one) {
  return one == PaperExperiment::jnd ? PaperExperiment::sorting : PaperExperiment::jnd;
}

std::string tile(double x, double row, std::string_view color) {
  return fmt::format(
      "set object rectangle from {},{} to {},{} fillcolor '{}' fillstyle solid border "
      "linecolor '#b0b6bd'\n",
      x, row, x + 0.86, row + 0.8, color);
}

std::string label(const std::string& text, double x, double row, std::string_view looks) {
  return fmt::format("set label {} at {},{} {}\n", gnuplot_quoted(text), x, row, looks);
}

class Tiles {
 public:
  Tiles(const std::vector<RivalResult>& results, const std::vector<PaperFigure>& figures)
      : results_(results), figures_(figures) {}

  std::string script() {
    for (const auto fitted_to : {PaperExperiment::jnd, PaperExperiment::sorting}) {
      left_ = fitted_to == PaperExperiment::jnd ? 0 : panel_step;
      put_headings(fitted_to);
      double row = 0;
      std::optional<RivalGroup> group;
      for (const RivalResult& result : results_) {
        if (result.fitted_to != fitted_to) continue;
        if (group && *group != result.rival.group) row += 0.5;
        group = result.rival.group;
        put_row(result, row++);
      }
      n_rows_ = row;
    }
    return script_;
  }

  double n_rows() const { return n_rows_; }

 private:
  double x_of(std::size_t figure) const {
    const bool second = figures_[figure].experiment == PaperExperiment::jnd;
    double x = left_ + (second ? gap : 0);
    for (std::size_t f = 0; f < figures_.size(); ++f)
      if (figures_[f].experiment < figures_[figure].experiment ||
          (figures_[f].experiment == figures_[figure].experiment && f < figure))
        ++x;
    return x;
  }

  void put_headings(PaperExperiment fitted_to) {
    for (std::size_t f = 0; f < figures_.size(); ++f)
      script_ += label(figures_[f].name, x_of(f) + 0.45, -0.35,
                       "left rotate by 60 font ',10' textcolor '#333333'");
    const bool jnd = fitted_to == PaperExperiment::jnd;
    script_ += label(jnd ? "fitted to experiment 2 (JNDs), predicts experiment 1 (sorting)"
                         : "fitted to experiment 1 (sorting), predicts experiment 2 (JNDs)",
                     left_, -5.6, "left font ',12'");
  }

  void put_row(const RivalResult& result, double row) {
    if (left_ == 0) script_ += label(result.rival.name, -label_gap, row + 0.42, "right font ',12'");
    const bool is_fitted = !result.rival.free.empty();
    for (std::size_t f = 0; f < figures_.size(); ++f) {
      const bool predicted = figures_[f].experiment != result.fitted_to;
      const std::string_view hit = !is_fitted ? no_fit_hit : predicted ? predicted_hit : fitted_hit;
      script_ += tile(x_of(f), row, result.figures[f].hit ? hit : miss);
    }
    const RivalResult::Total total = result.total(figures_, other_than(result.fitted_to));
    script_ +=
        label(fmt::format("{} of {}", total.n_hits, total.n),
              left_ + static_cast<double>(figures_.size()) + gap + 0.3, row + 0.42,
              fmt::format("left font ',12' textcolor '{}'", is_fitted ? predicted_hit : "#555555"));
  }

  const std::vector<RivalResult>& results_;
  const std::vector<PaperFigure>& figures_;
  std::string script_;
  double left_ = 0, n_rows_ = 0;
};

// Most predicted hits of one group, of both experiments together.
int most_hits(const std::vector<RivalResult>& results, const std::vector<PaperFigure>& figures,
              RivalGroup group) {
  std::map<std::string, int> hits;
  for (const RivalResult& result : results)
    if (result.rival.group == group)
      hits[result.rival.name] += result.total(figures, other_than(result.fitted_to)).n_hits;
  int most = 0;
  for (const auto& [name, n] : hits) most = std::max(most, n);
  return most;
}
}  // namespace

std::string rivals_chart(const std::vector<RivalResult>& results,
                         const std::vector<PaperFigure>& figures, int n_studies,
                         const StudyOptions& options) {
  Tiles tiles(results, figures);
  const std::string drawn = tiles.script();
  std::string script = gnuplot_header(
      {"models.svg", width_px, height_px,
       fmt::format("Predicted figures of the paper, of {}: at most {} by a mechanism, {} by a null "
                   "model",
                   figures.size(), most_hits(results, figures, RivalGroup::mechanism),
                   most_hits(results, figures, RivalGroup::null)),
       fmt::format(
           "A filled tile: the paper's figure is within the central 95 % of {} simulated studies "
           "of 13 people. Dark: the model was fitted to the other experiment. Pale: the figure was "
           "fitted. Gray: nothing was fitted. \"n of n\" counts the predicted tiles. From the top: "
           "four mechanisms, six null models, and an observer without noise as the bound of what "
           "the display shows. README.md has what follows. {}",
           n_studies, provenance(options))});
  script += "unset border\nunset tics\nunset grid\nunset key\n";
  script += gnuplot_place(0.2, 0.985, 60, height_px - 62);
  script += fmt::format("set xrange [0:{}]\nset yrange [{}:-6]\n", panel_step + 18.6,
                        tiles.n_rows() + 0.2);
  return script + drawn + "plot NaN notitle\n";
}

}  // namespace heft
