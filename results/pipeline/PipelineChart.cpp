#include <array>

#include "analysis/charts/Plot.h"
#include "results/Study.h"
#include "results/pipeline/Chain.h"
#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr int width_px = 980, height_px = 420;
constexpr std::array<std::string_view, 9> colors{"#8a94a0", "#c9cfd6", "#1f5fa8",
                                                 "#5b9bd5", "#3c8d5a", "#9ccc65",
                                                 "#c0561f", "#b8860b", "#7a5aa6"};

std::string block(double from, double to, double row, std::string_view color) {
  return fmt::format(
      "set object rectangle from {},{} to {},{} fillcolor '{}' fillstyle solid "
      "noborder\n",
      from, row - 0.28, to, row + 0.28, color);
}

std::string label(const std::string& text, double x, double y, std::string_view color) {
  return fmt::format("set label {} at {},{} center front font ',10' textcolor '{}'\n",
                     gnuplot_quoted(text), x, y, color);
}

// From left to right; narrow stages are named in the key alone.
std::string bar(const Budget& budget, double row, double full_ms) {
  std::string script;
  double at = 0;
  for (std::size_t i = 0; i < budget.stages.size(); ++i) {
    const BudgetLine& stage = budget.stages[i];
    script += block(at, at + stage.median_ms, row, colors.at(i));
    if (stage.median_ms > 0.055 * full_ms)
      script += label(fmt::format("{} {:.1f}", stage.stage, stage.median_ms),
                      at + stage.median_ms / 2, row, "#ffffff");
    at += stage.median_ms;
  }
  script += fmt::format(
      "set arrow from {0},{1} to {0},{2} nohead linewidth 2 dashtype 2 linecolor '#333333' front\n",
      budget.goal_ms(), row - 0.4, row + 0.4);
  return script + label(fmt::format("goal without physics {:g}", budget.goal_ms()),
                        budget.goal_ms(), row + 0.47, "#333333");
}
}  // namespace

std::string pipeline_chart(const std::vector<Budget>& budgets, const StudyOptions& options) {
  double full_ms = 0;
  for (const Budget& budget : budgets)
    full_ms = std::max({full_ms, budget.whole.p95_ms, budget.goal_ms()});
  full_ms *= 1.08;
  std::string script = gnuplot_header(
      {"pipeline.svg", width_px, height_px, "Where a picture's time goes",
       fmt::format(
           "Medians over {} pictures of one thread's processor time, from a JPEG file to "
           "what is shown; present: a copy, no display. Three cubes of 15, 200 and 800 g, "
           "default simulator, 15 pictures a second. The JPEGs have quality 95 and hold the "
           "sensor's noise, so they decode slower than most cameras' do. {}",
           budgets.empty() ? 0 : budgets.front().n_pictures, provenance(options))});
  script += fmt::format(
      "set tmargin at screen 1-60*pixel\nset bmargin at screen caption_top + 100*pixel\n"
      "set lmargin 13\nset rmargin 4\nset xrange [0:{}]\nset yrange [{}:0.4]\n"
      "unset ytics\nunset grid\nset grid xtics linetype 1 linecolor '#e4e4e4'\n"
      "set border 1\nset xlabel 'processor time per picture (ms)'\n",
      full_ms, static_cast<double>(budgets.size()) + 0.6);
  std::string tics, keys;
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    const double row = static_cast<double>(i) + 1;
    tics += fmt::format("{}'{}' {}", i ? ", " : "", size_name(budgets[i].width_px), row);
    script += bar(budgets[i], row, full_ms);
    if (i > 0) continue;
    for (std::size_t s = 0; s < budgets[i].stages.size(); ++s)
      keys += fmt::format("{}NaN with boxes fillstyle solid linecolor '{}' title '{}'",
                          s ? ", " : "", colors.at(s), budgets[i].stages[s].stage);
  }
  script += fmt::format(
      "set ytics nomirror scale 0 ({})\nset key at screen 0.5, caption_top + 12*pixel center "
      "maxrows 1 font ',11' samplen 1\nplot {}\n",
      tics, keys);
  return script;
}

}  // namespace heft
