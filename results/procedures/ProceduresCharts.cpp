#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/charts/Plot.h"
#include "results/procedures/ProceduresStudy.h"

namespace heft {

namespace {
constexpr int tiles_at_trials = 60;
constexpr std::string_view good = "#dfeaf5", fair = "#f5dfae", bad = "#e2935a", none = "#e3e3e3",
                           false_threshold = "#c9564f";

bool is_person(std::string_view name) {
  return std::ranges::any_of(study_observers(), [&](const Observer& observer) {
    return observer.name == name && observer.kind == Observer::Kind::person;
  });
}

double percent(double log_ratio) {
  return 100 * (std::exp(log_ratio) - 1);
}

std::string_view title_of(AnswerSet answers) {
  return answers == AnswerSet::three_way ? "three answers" : "forced choice";
}

bool is_posterior(StudiedProcedure::Own own) {
  return own == StudiedProcedure::Own::posterior;
}

std::string row_name(const ObserverFigures& row) {
  return fmt::format("{}: {}", row.procedure,
                     row.estimator == Estimator::fit ? "fit of all trials"
                     : is_posterior(row.own)         ? "posterior"
                                                     : "mean of reversals");
}

struct Tile {
  std::string_view color;
  std::string text;
};

Tile tile_of(const ObserverFigures& row) {
  const double printed = static_cast<double>(row.n_printed) / row.n_runs;
  const std::string share = fmt::format("{:.0f}%", 100 * printed);
  if (!is_person(row.observer)) return {printed > 0.05 ? false_threshold : good, share};
  if (printed < 0.5) return {none, share};
  const double bias = percent(row.bias), size = std::abs(bias);
  return {size <= 10 ? good : size <= 25 ? fair : bad, fmt::format("{:+.0f}", bias)};
}

class Tiles {
 public:
  std::string script(const std::vector<ObserverFigures>& figures) {
    for (std::size_t i = 0; i < study_observers().size(); ++i)
      put_label(std::string(study_observers()[i].name), static_cast<double>(i) + 0.5, -0.3,
                "left rotate by 50 font ',10' textcolor '#333333'");
    for (const AnswerSet answers : {AnswerSet::three_way, AnswerSet::forced_choice}) {
      put_label(std::string(title_of(answers)), -0.2, row_ + 0.45, "right font ',12'");
      row_ += 1;
      std::map<std::string, double> rows;  // where they are
      for (const ObserverFigures& row : figures) {
        if (row.answers != answers || row.n_trials != tiles_at_trials) continue;
        const auto [place, is_new] = rows.try_emplace(row_name(row), row_);
        if (is_new) {
          put_label(place->first, -0.2, row_ + 0.45, "right font ',11'");
          row_ += 1;
        }
        put_tile(tile_of(row), column_of(row.observer), place->second);
      }
      row_ += 0.5;
    }
    return script_;
  }
  double n_rows() const { return row_; }

 private:
  static double column_of(std::string_view observer) {
    const auto found = std::ranges::find(study_observers(), observer, &Observer::name);
    return static_cast<double>(found - study_observers().begin());
  }
  void put_label(const std::string& text, double x, double y, std::string_view looks) {
    script_ += fmt::format("set label {} at {},{} front {}\n", gnuplot_quoted(text), x, y, looks);
  }
  void put_tile(const Tile& tile, double x, double y) {
    script_ += fmt::format(
        "set object rectangle from {},{} to {},{} fillcolor '{}' fillstyle solid border "
        "linecolor '#b0b6bd'\n",
        x + 0.04, y + 0.05, x + 0.96, y + 0.95, tile.color);
    put_label(tile.text, x + 0.5, y + 0.5, "center font ',10'");
  }

  std::string script_;
  double row_ = 0;
};

/// The same procedure has one color in both panels.
std::size_t color_of(std::string_view procedure) {
  constexpr std::array<std::string_view, 7> first_words{
      "1-up-1-down of d", "1-up-1-down of c", "weighted", "constant", "QUEST+", "QUEST", "Psi"};
  const auto found = std::ranges::find_if(
      first_words, [&](std::string_view words) { return procedure.starts_with(words); });
  return found == first_words.end() ? 7 : static_cast<std::size_t>(found - first_words.begin());
}

/// Median over people, in the order of trials_read; NaN where too few runs gave a threshold.
/// @param line a row of the same answers, procedure and estimator
std::vector<double> median_errors(const std::vector<ObserverFigures>& figures,
                                  const ObserverFigures& line) {
  std::vector<double> medians;
  for (const int n_trials : trials_read) {
    std::vector<double> errors;
    for (const ObserverFigures& row : figures)
      if (row.answers == line.answers && row.procedure == line.procedure &&
          row.estimator == line.estimator && row.n_trials == n_trials && is_person(row.observer))
        errors.push_back(2 * row.n_printed < row.n_runs ? INFINITY : row.rmse);
    std::ranges::sort(errors);
    const double median = errors[errors.size() / 2];
    medians.push_back(std::isfinite(median) ? median : NAN);
  }
  return medians;
}
}  // namespace

std::string failures_chart(const std::vector<ObserverFigures>& figures,
                           const StudyOptions& options) {
  Tiles tiles;
  const std::string drawn = tiles.script(figures);
  constexpr int width_px = 1280, height_px = 940;
  std::string script = gnuplot_header(
      {"failures.svg", width_px, height_px,
       fmt::format("How far thresholds are off after {} trials, by procedure and person",
                   tiles_at_trials),
       fmt::format(
           "Numbers: bias of the threshold in percent. Blue: at most 10, yellow: at most 25, "
           "orange: more. Gray: most sessions gave no threshold (share that did). The three last "
           "columns are answers without any threshold: share of sessions that print one, red above "
           "5 %. {} simulated sessions each, reference 200 g. {}",
           figures.empty() ? 0 : figures.front().n_runs, provenance(options))});
  script += "unset border\nunset tics\nunset grid\nunset key\n";
  script += gnuplot_place(0.27, 0.93, 60, height_px - 62);
  script += fmt::format("set xrange [0:{}]\nset yrange [{}:-7]\n", study_observers().size(),
                        tiles.n_rows());
  return script + drawn + "plot NaN notitle\n";
}

std::string errors_chart(const std::vector<ObserverFigures>& figures, const StudyOptions& options) {
  constexpr int width_px = 1180, height_px = 700;
  std::string script = gnuplot_header(
      {"errors.svg", width_px, height_px, "How fast thresholds become exact",
       fmt::format("RMS error of the natural logarithm of the threshold (0.1: about 10 %), median "
                   "over the people that have a threshold. Solid: posterior, or fit of all trials. "
                   "Dashed: mean "
                   "of reversals. {}",
                   provenance(options))});
  script +=
      "set multiplot\nset logscale xy\nset xtics (20, 40, 60, 100)\nset ytics (0.1, 0.15, 0.2, "
      "0.3, 0.5, 0.7, 1, 1.5)\nset yrange [0.1:1.6]\nset xrange [18:110]\n"
      "set xlabel 'trials'\nset key at graph 0.8,-0.24 maxcols 1 font ',11'\n";
  double left = 0.06;
  for (const AnswerSet answers : {AnswerSet::three_way, AnswerSet::forced_choice}) {
    std::string data, plot = "plot ";
    for (const ObserverFigures& row : figures) {
      const bool is_first_of_line =
          row.observer == figures.front().observer && row.n_trials == trials_read.front();
      const bool posterior = is_posterior(row.own), fitted = row.estimator == Estimator::fit;
      if (row.answers != answers || !is_first_of_line || (posterior && fitted)) continue;
      const bool dashed = !posterior && !fitted;
      const std::size_t color = color_of(row.procedure);
      const std::string block = fmt::format("$line{}_{}", color, dashed);
      const auto errors = median_errors(figures, row);
      data += block + " << END\n";
      for (std::size_t i = 0; i < errors.size(); ++i)
        data += fmt::format("{} {}\n", trials_read[i], errors[i]);
      data += "END\n";
      plot += fmt::format(
          "{} using 1:2 with linespoints pointtype {} pointsize 0.6 linewidth 2 dashtype {} "
          "linecolor '{}' {}, ",
          block, series_sign(color), dashed ? 2 : 1, series_color(color),
          dashed ? "notitle" : "title " + gnuplot_quoted(row.procedure));
    }
    script += data + gnuplot_place(left, left + 0.42, 90, height_px - 250);
    script += fmt::format("set title {}\nset ylabel '{}'\n", gnuplot_quoted(title_of(answers)),
                          answers == AnswerSet::three_way ? "error of ln threshold" : "");
    script += plot + "NaN notitle\n";
    left += 0.5;
  }
  return script + "unset multiplot\n";
}

}  // namespace heft
