// Places on a chart's x axis, and the names of its series.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "analysis/charts/Plot.h"
#include "analysis/display/ChartSpec.h"

namespace heft {

using Chosen = std::vector<const StudyEstimate*>;

// Where an axis of values from 0 ends: intervals much longer than that are cut, because they would
// shrink all others to points.
class AxisEnd {
 public:
  void add(const StudyEstimate& one) {
    add(one.value, one.high);
    if (!one.published) return;
    const auto interval = interval_of(*one.published);
    add(one.published->value, interval ? std::optional(interval->high) : std::nullopt);
  }
  bool cuts() const { return furthest_ > most_values * most_; }
  std::string text() const { return cuts() ? fmt::format("{:g}", most_values * most_) : "*"; }

  static constexpr std::string_view caption = " Intervals that reach the frame extend beyond it.";

 private:
  void add(std::optional<double> value, std::optional<double> high) {
    most_ = std::max(most_, value.value_or(0));
    furthest_ = std::max(furthest_, high.value_or(0));
  }

  static constexpr double most_values = 3;
  double most_ = 0, furthest_ = 0;
};

inline std::string text_of(const StudyEstimate& estimate, std::string_view coordinate) {
  const std::string text = estimate.text_at(coordinate);
  return coordinate == "reference_g" && !text.empty() ? text + " g" : text;
}

// "200 g, soft"
inline std::string text_of(const StudyEstimate& estimate,
                           const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names)
    if (const std::string one = text_of(estimate, name); !one.empty())
      text += (text.empty() ? "" : ", ") + one;
  return text;
}

inline bool belongs(const StudyEstimate& estimate, const ChartSeries& series) {
  return estimate.measure == series.measure &&
         (series.only.first.empty() || text_of(estimate, series.only.first) == series.only.second);
}

inline void add_new(std::vector<std::string>& texts, std::string text) {
  if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
}

// One series of the chart's declaration, for one value of its split.
struct Drawn {
  std::string title;
  Chosen estimates, participants;
  std::size_t look = 0;
};

// Places on the x axis: numbers, or one after the other in the order in which they come.
class XAxis {
 public:
  XAxis(const std::vector<Drawn>& all, std::string_view coordinate, bool logarithmic = false)
      : coordinate_(coordinate), logarithmic_(logarithmic), n_series_(all.size()) {
    for (const Drawn& drawn : all)
      for (const Chosen* chosen : {&drawn.estimates, &drawn.participants})
        for (const StudyEstimate* one : *chosen) add(*one);
  }
  bool is_numeric() const { return texts_.empty(); }
  // @param aside offset in steps, to be beside others
  double at(const StudyEstimate& one, double aside = 0) const {
    const auto x = number(one);
    if (x && logarithmic_) return *x * std::pow(1.08, aside);
    if (x) return *x + aside * step();
    const std::string text = text_of(one, coordinate_);
    return static_cast<double>(std::ranges::find(texts_, text) - texts_.begin()) + aside * step();
  }
  // Height in pixels of names that are turned because they do not fit beside each other; 0: they
  // do.
  int turned_px(int width_px) const {
    constexpr double character_px = 7.5, sine = 0.5;
    std::size_t longest = 0;
    for (const std::string& text : texts_) longest = std::max(longest, text.size());
    const double name_px = character_px * static_cast<double>(longest);
    const bool fit = name_px * static_cast<double>(texts_.size()) <= width_px;
    return fit ? 0 : static_cast<int>(sine * name_px);
  }
  std::string axes(int width_px) const {
    if (is_numeric() && logarithmic_)
      return fmt::format(
          "set xrange [{}:{}]\n{}", low() / 1.3, high() * 1.3,
          places_.size() <= most_tics && are_whole() ? tics_at_places() : tics_on_logarithm());
    if (is_numeric()) {
      const double aside =
          high() > low() ? step() * (static_cast<double>(n_series_) + 1) : 0.5 * span();
      return fmt::format("set xrange [{}:{}]\n{}", low() - aside, high() + aside,
                         are_apart() ? tics_at_places() : fmt::format("set xtics {}\n", tic()));
    }
    std::string tics;
    for (std::size_t i = 0; i < texts_.size(); ++i)
      tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_quoted(texts_[i]), i);
    return fmt::format("set xrange [-0.6:{}]\nset xtics scale 0 {} ({})\n",
                       static_cast<double>(texts_.size()) - 0.4,
                       turned_px(width_px) > 0 ? "rotate by 30 right" : "norotate", tics);
  }

 private:
  double step() const {
    if (!is_numeric()) return 0.62 / static_cast<double>(std::max<std::size_t>(n_series_, 2));
    const double n = static_cast<double>(n_series_);
    if (places_.size() == 1) return 0.62 * span() / std::max(n, 2.0);
    return std::min(0.03 * span(), 0.8 * least_gap() / (n + 1));
  }
  double low() const { return *places_.begin(); }
  double high() const { return *places_.rbegin(); }
  // Length of the axis; for a single value, that of its neighborhood.
  double span() const { return high() > low() ? high() - low() : std::max(std::abs(low()), 1.0); }
  double least_gap() const {
    double gap = span();
    for (auto place = places_.begin(); std::next(place) != places_.end(); ++place)
      gap = std::min(gap, *std::next(place) - *place);
    return gap;
  }
  bool are_whole() const {
    return std::ranges::all_of(places_, [](double x) { return x == std::round(x); });
  }
  // Whole numbers, far enough apart to write a tic at each.
  bool are_apart() const { return least_gap() > 0.1 * span() && are_whole(); }
  std::string tics_at_places() const {
    return fmt::format("set xtics ({:g})\n", fmt::join(places_, ", "));
  }
  // 1, 2 and 5 of each decade.
  std::string tics_on_logarithm() const {
    std::vector<double> tics;
    for (double power = std::floor(std::log10(low())); power <= std::log10(high()); power += 1)
      for (const double factor : {1.0, 2.0, 5.0}) tics.push_back(factor * std::pow(10, power));
    return fmt::format("set xtics ({:g})\n", fmt::join(tics, ", "));
  }
  void add(const StudyEstimate& one) {
    if (const auto x = number(one))
      places_.insert(*x);
    else
      add_new(texts_, text_of(one, coordinate_));
  }
  // Distance of tics: about six on the axis, however narrow the panel is.
  double tic() const {
    const double rough = span() / 6;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
      if (rough <= factor * power) return factor * power;
    return 10 * power;
  }
  std::optional<double> number(const StudyEstimate& one) const {
    if (coordinate_ == "reference_g") return one.reference_g;
    const Coordinate* found = one.at(coordinate_);
    return found ? found->value : std::nullopt;
  }

  static constexpr std::size_t most_tics = 8;

  std::string_view coordinate_;
  bool logarithmic_;
  std::size_t n_series_;
  std::vector<std::string> texts_;
  std::set<double> places_;
};

}  // namespace heft
