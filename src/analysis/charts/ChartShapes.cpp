// The shapes of charts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/charts/ChartAxis.h"
#include "analysis/charts/Plot.h"
#include "analysis/display/Phrases.h"

namespace heft {

namespace {
std::string row_of(double x, const StudyEstimate& one) {
  return fmt::format("{} {} {} {}\n", x, *one.value, one.low.value_or(*one.value),
                     one.high.value_or(*one.value));
}

class Drawing {
 public:
  Drawing(const ChartSpec& spec, const Summary& summary, const Estimates& of_participants)
      : spec_(spec), summary_(summary) {
    const auto choose = [&](const Estimates& from, Chosen& chosen) {
      for (const StudyEstimate& one : from)
        if ((one.value || one.published) &&
            std::ranges::any_of(spec.series,
                                [&](const ChartSeries& series) { return belongs(one, series); }))
          chosen.push_back(&one);
    };
    choose(summary.estimates, estimates_);
    choose(of_participants, participants_);
    std::ranges::copy_if(spec.split, std::back_inserter(split_), [&](std::string_view name) {
      return name == "condition" || varies(name);
    });
    for (const Chosen* chosen : {&estimates_, &participants_}) {
      for (const StudyEstimate* one : *chosen) add_new(panels_, text_of(*one, spec.panels));
      for (std::size_t i = 0; i < spec.series.size(); ++i)
        for (const StudyEstimate* one : *chosen)
          if (belongs(*one, spec.series[i])) add_new(looks_, look_of(i, *one));
    }
    if (spec.shape == ChartShape::linked || spec.shape == ChartShape::people ||
        spec.shape == ChartShape::scatter)
      std::swap(estimates_, participants_);
  }

  Chart chart() {
    Chart chart{spec_.name, titled(spec_.title, summary_), "", spec_.caption, 0, spec_.csv};
    std::vector<PlotPanel> panels;
    if (!estimates_.empty())
      for (const std::string& name : panels_)
        if (PlotPanel panel = panel_named(name); !panel.layers.empty())
          panels.push_back(std::move(panel));
    if (panels.empty()) return chart;
    for (const StudyEstimate* one : estimates_) {
      if (!one->value) continue;
      chart.least_n = chart.n == 0 ? one->n : std::min(chart.least_n, one->n);
      chart.n = std::max(chart.n, one->n);
    }
    if (spec_.shape == ChartShape::linked || spec_.shape == ChartShape::people ||
        spec_.shape == ChartShape::scatter)
      chart.n = chart.least_n = n_people();
    PlotFrame frame;
    frame.panel_width_px = panel_width_px();
    if (spec_.shape == ChartShape::matrix) {
      frame.left_px = frame.gap_x_px = 130;  // for the names of the rows
      frame.panel_width_px = 300;
    }
    if (spec_.shape == ChartShape::people) {
      frame.panel_width_px = panels.size() > 1 ? 420 : 760;
      frame.most_columns = 2;
    }
    frame.axes = fmt::format("set xlabel {}\nset ylabel {}\n{}", gnuplot_quoted(spec_.x_label),
                             gnuplot_quoted(spec_.y_label), spec_.axes);
    cut_axis(chart, frame);
    put_script(chart, summary_, frame, panels);
    return chart;
  }

 private:
  void cut_axis(Chart& chart, PlotFrame& frame) const {
    constexpr std::string_view open = "set yrange [0:*]";
    const auto place = frame.axes.find(open);
    AxisEnd end;
    for (const Chosen* chosen : {&estimates_, &participants_})
      for (const StudyEstimate* one : *chosen) end.add(*one);
    if (place == std::string::npos || !end.cuts()) return;
    frame.axes.replace(place, open.size(), fmt::format("set yrange [0:{}]", end.text()));
    chart.caption += AxisEnd::caption;
  }

  std::string look_of(std::size_t series, const StudyEstimate& one) const {
    const std::string& title = spec_.series[series].title;
    const std::string split = text_of(one, split_);
    const std::string named = !title.empty() ? title
                              : spec_.series.size() > 1 || split.empty()
                                  ? std::string(one.measure->heading)
                                  : "";
    return named + (named.empty() || split.empty() ? "" : ", ") + split;
  }

  std::vector<Drawn> drawn_in(const std::string& panel) const {
    std::vector<Drawn> all;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      Drawn drawn{looks_[i], {}, {}, i};
      const auto put = [&](const Chosen& from, Chosen& to) {
        for (const StudyEstimate* one : from)
          for (std::size_t s = 0; s < spec_.series.size(); ++s)
            if (text_of(*one, spec_.panels) == panel && belongs(*one, spec_.series[s]) &&
                look_of(s, *one) == looks_[i])
              to.push_back(one);
      };
      put(estimates_, drawn.estimates);
      put(participants_, drawn.participants);
      all.push_back(std::move(drawn));
    }
    std::erase_if(all, [](const Drawn& drawn) {
      return drawn.estimates.empty() && drawn.participants.empty();
    });
    return all;
  }

  bool varies(std::string_view name) const {
    std::vector<std::string> texts;
    for (const Chosen* chosen : {&estimates_, &participants_})
      for (const StudyEstimate* one : *chosen) add_new(texts, text_of(*one, name));
    return texts.size() > 1;
  }

  int n_people() const {
    std::vector<std::string> names;
    for (const StudyEstimate* one : estimates_) add_new(names, one->participant);
    return static_cast<int>(names.size());
  }

  int panel_width_px() const { return panels_.size() > 1 ? 300 : 600; }

  void put_axis(PlotPanel& panel, const XAxis& axis) const {
    panel.axes += axis.axes(panel_width_px());
    panel.tics_px = axis.turned_px(panel_width_px());
  }

  PlotPanel panel_named(const std::string& name) const {
    PlotPanel panel{name, "", {}};
    const std::vector<Drawn> all = drawn_in(name);
    if (spec_.shape == ChartShape::matrix) return matrix(std::move(panel), all);
    if (spec_.shape == ChartShape::scatter) return scatter(std::move(panel), name);
    if (spec_.shape == ChartShape::people) return people(std::move(panel), all);
    if (spec_.shape == ChartShape::linked) return linked(std::move(panel), all);
    return against_x(std::move(panel), all);
  }

  PlotPanel against_x(PlotPanel panel, const std::vector<Drawn>& all) const {
    const bool joined = spec_.shape == ChartShape::lines;
    const bool side_by_side = !joined && !spec_.has_bands();
    const XAxis axis(all, spec_.x, has_axes("logscale x"));
    put_axis(panel, axis);
    std::string published;
    for (const ChartSeries& series : spec_.series) add_band(panel, axis, series);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Drawn& drawn = all[i];
      const double aside =
          side_by_side ? static_cast<double>(i) - (static_cast<double>(all.size()) - 1) / 2 : 0;
      if (spec_.participants) add_participants(panel, axis, drawn, aside - 0.45);
      std::string rows;
      for (const StudyEstimate* one : drawn.estimates) {
        if (one->value) rows += row_of(axis.at(*one, aside), *one);
        if (one->published) {
          StudyEstimate paper = *one;
          paper.value = one->published->value;
          paper.low = paper.high = std::nullopt;
          paper.set(interval_of(*one->published));
          published += row_of(axis.at(*one, aside + 0.3), paper);
        }
      }
      const std::string how = fmt::format(
          "using 1:2:3:4 with {} dashtype {} pointtype {} pointsize 0.9 linewidth 1.7 linecolor "
          "'{}'",
          joined ? "yerrorlines" : "yerrorbars", joined ? series_dash(drawn.look) : 1,
          series_sign(drawn.look), series_color(drawn.look));
      panel.layers.push_back({rows, how, drawn.title, rows.empty()});
    }
    add_reference(panel, axis, static_cast<double>(all.size()) / 2 + 0.1);
    panel.add(published,
              fmt::format("using 1:2:3:4 with yerrorbars pointtype 12 pointsize 1.2 linewidth 1.3 "
                          "linecolor '{}'",
                          published_color),
              fmt::format("published (n = {})", published::n_participants));
    return panel;
  }

  // Draws the model's band from the estimates of this panel.
  void add_band(PlotPanel& panel, const XAxis& axis, const ChartSeries& series) const {
    if (series.band.empty()) return;
    std::map<double, std::string> rows;
    for (const StudyEstimate* one : estimates_of(summary_.estimates, series.band))
      if (text_of(*one, spec_.panels) == panel.title && one->value)
        rows[axis.at(*one)] = row_of(axis.at(*one), *one);
    std::string sorted;
    for (const auto& [x, row] : rows) sorted += row;
    const auto look = static_cast<std::size_t>(&series - spec_.series.data());
    panel.add(sorted, fmt::format("using 1:3:4 with filledcurves fillstyle transparent solid 0.18 "
                                  "noborder linecolor '{}'",
                                  series_color(look)));
  }

  // Adds participants: points beside their mean, arrows where an estimate is censored; in charts of
  // lines a thin line each.
  void add_participants(PlotPanel& panel, const XAxis& axis, const Drawn& drawn,
                        double aside) const {
    if (spec_.shape == ChartShape::lines || spec_.has_bands()) {
      std::map<std::string, std::string> lines;
      for (const StudyEstimate* one : drawn.participants)
        lines[one->participant] += row_of(axis.at(*one), *one);
      std::string rows;
      for (const auto& [participant, line] : lines) rows += line + '\n';
      panel.add(rows, "using 1:2 with lines linewidth 0.6 linecolor '#b9cde3'");
      return;
    }
    struct Look {
      Censored censored;
      std::string_view sign, title;
    };
    for (const Look& look : {Look{Censored::none, "pointtype 7 pointsize 0.4", "each participant"},
                             Look{Censored::above, "pointtype 8 pointsize 0.75", "> this"},
                             Look{Censored::below, "pointtype 10 pointsize 0.75", "< this"}}) {
      std::string rows;
      for (const StudyEstimate* one : drawn.participants)
        if (one->censored == look.censored) rows += row_of(axis.at(*one, aside), *one);
      if (rows.empty()) continue;
      const std::string how = fmt::format("using 1:2 with points {} linecolor ", look.sign);
      panel.layers.push_back({"", how + "'#777777'", std::string(look.title), true});
      panel.add(rows, fmt::format("{}'{}'", how, series_color(drawn.look)));
    }
  }

  // Draws a reference value at its coordinate, or across the panel.
  void add_reference(PlotPanel& panel, const XAxis& axis, double half) const {
    if (!spec_.reference) return;
    std::string rows;
    std::vector<std::string> values;
    for (const StudyEstimate& one : summary_.estimates) {
      if (one.measure != spec_.reference || !one.value) continue;
      rows += fmt::format("{} {}\n{} {}\n\n", axis.at(one, -half), *one.value, axis.at(one, half),
                          *one.value);
      add_new(values, fmt::format("{:.1f}", *one.value));
    }
    panel.add(rows, "using 1:2 with lines dashtype 2 linewidth 1.6 linecolor '#222222'",
              fmt::format("{} ({} {})", spec_.reference->heading, fmt::join(values, ", "),
                          spec_.reference->unit));
  }

  PlotPanel linked(PlotPanel panel, const std::vector<Drawn>& all) const {
    const XAxis axis(all, spec_.x);
    put_axis(panel, axis);
    for (const Drawn& drawn : all) {
      std::map<std::string, std::string> lines;
      for (const StudyEstimate* one : drawn.estimates) {
        // so that equal lines don't hide each other
        const double aside = 0.02 * (static_cast<double>(lines.size() % 9) - 4);
        const auto [line, is_new] = lines.try_emplace(one->participant);
        (void)is_new;
        asides_.try_emplace(one->participant, aside);
        line->second += row_of(axis.at(*one) + asides_.at(one->participant), *one);
      }
      std::string rows;
      for (const auto& [participant, line] : lines) rows += line + '\n';
      panel.add(rows, "using 1:2 with lines linecolor '#9bb8d6'");
      panel.add(rows,
                fmt::format("using 1:2 with points pointtype 6 pointsize 0.8 linecolor '{}'",
                            series_color(drawn.look)),
                "participant");
    }
    add_reference(panel, axis, 1);
    return panel;
  }

  // A column for each participant, ordered by the first series that they have.
  PlotPanel people(PlotPanel panel, const std::vector<Drawn>& all) const {
    std::vector<std::string> names;
    for (const Drawn& drawn : all) {
      Chosen sorted = drawn.estimates;
      std::ranges::stable_sort(sorted, {}, [](const StudyEstimate* one) { return *one->value; });
      for (const StudyEstimate* one : sorted) add_new(names, one->participant);
    }
    panel.axes += fmt::format("set xrange [0:{}]\nset xtics 1,{},{}\n", names.size() + 1,
                              std::max<std::size_t>(1, names.size() / 8), names.size());
    for (const Drawn& drawn : all) {
      std::string rows;
      for (const StudyEstimate* one : drawn.estimates) {
        const auto x = std::ranges::find(names, one->participant) - names.begin() + 1;
        StudyEstimate shown = *one;
        if (has_axes("logscale y")) {
          if (*one->value <= 0) continue;
          if (shown.low) shown.low = std::max(*shown.low, 0.1);
        }
        rows += row_of(static_cast<double>(x), shown);
      }
      panel.add(rows,
                fmt::format("using 1:2:3:4 with yerrorbars pointtype {} pointsize 0.7 linecolor "
                            "'{}'",
                            series_sign(drawn.look), series_color(drawn.look)),
                drawn.title);
    }
    return panel;
  }
  bool has_axes(std::string_view what) const { return spec_.axes.find(what) != std::string::npos; }

  // One point for each participant: the values of both series at the same coordinates.
  PlotPanel scatter(PlotPanel panel, const std::string& name) const {
    std::map<std::string, std::string> rows;
    for (const StudyEstimate* x : estimates_)
      if (belongs(*x, spec_.series.at(0)) && text_of(*x, spec_.panels) == name)
        for (const StudyEstimate* y : estimates_)
          if (belongs(*y, spec_.series.at(1)) && y->participant == x->participant &&
              y->condition == x->condition && y->reference_g == x->reference_g && same(*x, *y))
            rows[text_of(*x, spec_.split) +
                 (y->censored == Censored::none
                      ? ""
                      : std::string(", ") + std::string(beyond_sign(y->censored)) + "this")] +=
                fmt::format("{} {}\n", *x->value, *y->value);
    std::size_t i = 0;
    for (const auto& [title, points] : rows) {
      panel.add(points,
                fmt::format("using 1:2 with points pointtype {} pointsize 0.8 linecolor '{}'",
                            series_sign(i), series_color(i)),
                title.empty() ? "participant" : title);
      ++i;
    }
    if (spec_.diagonal && !panel.layers.empty())
      panel.layers.push_back({"", "x with lines dashtype 2 linecolor '#777777'", ""});
    return panel;
  }
  static bool same(const StudyEstimate& x, const StudyEstimate& y) {
    return std::ranges::equal(x.by, y.by, {}, &Coordinate::text, &Coordinate::text);
  }

  PlotPanel matrix(PlotPanel panel, const std::vector<Drawn>& all) const {
    if (all.empty()) return panel;
    std::vector<std::string> columns, lines;
    std::map<std::string, double> sums;
    for (const StudyEstimate* one : all.front().estimates) {
      add_new(columns, text_of(*one, spec_.x));
      add_new(lines, text_of(*one, spec_.y));
      sums[text_of(*one, spec_.y)] += *one->value;
    }
    const auto place = [](const std::vector<std::string>& texts, const std::string& text) {
      return std::ranges::find(texts, text) - texts.begin();
    };
    const auto tics = [](const std::vector<std::string>& texts) {
      std::string text;
      for (std::size_t i = 0; i < texts.size(); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_quoted(texts[i]), i);
      return text;
    };
    std::string rows;
    for (const StudyEstimate* one : all.front().estimates) {
      const std::string line = text_of(*one, spec_.y);
      rows += fmt::format("{} {} {:.1f} {}\n", place(columns, text_of(*one, spec_.x)),
                          place(lines, line), sums[line] > 0 ? 100 * *one->value / sums[line] : 0.0,
                          *one->value);
    }
    panel.axes += fmt::format(
        "unset grid\nset tics scale 0\nunset colorbox\n"
        "set palette defined (0 '#ffffff', 100 '#7fb0dd')\nset cbrange [0:100]\n"
        "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset xtics ({})\nset ytics ({})\n",
        static_cast<double>(columns.size()) - 0.5, static_cast<double>(lines.size()) - 0.5,
        tics(columns), tics(lines));
    panel.add(rows, "using 1:2:3 with image pixels");
    panel.add(rows, "using 1:2:(sprintf('%d\\n%.0f %%', $4, $3)) with labels");
    return panel;
  }

  const ChartSpec& spec_;
  const Summary& summary_;
  Chosen estimates_, participants_;
  std::vector<std::string_view> split_;  // the condition, and what is not the same everywhere
  std::vector<std::string> panels_, looks_;
  mutable std::map<std::string, double> asides_;
};
}  // namespace

Chart draw(const ChartSpec& spec, const Summary& summary, const Estimates& of_participants) {
  return Drawing(spec, summary, of_participants).chart();
}

}  // namespace heft
