// JND against reference mass: participants, mean with interval, and the paper's.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/Published.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
// Points of one reference stand side by side.
constexpr double participants_dx = -0.022, published_dx = 0.022;  // of the x axis

std::vector<ReferenceJnd> drawn(const Summary& summary) {
  std::vector<ReferenceJnd> jnds;
  for (const ReferenceJnd& jnd : summary.jnd)
    if (jnd.n() > 0 && jnd.compared.condition == "C2") jnds.push_back(jnd);
  return jnds;
}

std::string interval_line(double reference_g, double mean_g, const Interval& interval) {
  return fmt::format("{} {} {} {}\n", reference_g, mean_g, interval.low, interval.high);
}

std::string measured_block(std::span<const ReferenceJnd> jnds) {
  std::string block = "$measured << END\n";
  for (const ReferenceJnd& jnd : jnds)
    if (jnd.mean_g)
      block += interval_line(jnd.compared.reference_g, *jnd.mean_g,
                             jnd.interval_g.value_or(Interval{*jnd.mean_g, *jnd.mean_g}));
  return block + "END\n";
}

std::string participants_block(std::span<const ReferenceJnd> jnds, std::string_view name,
                               Censored censored) {
  std::string block = fmt::format("${} << END\n", name);
  for (const ReferenceJnd& jnd : jnds)
    for (const ParticipantJnd& one : jnd.participants)
      if (one.censored == censored)
        block += fmt::format("{} {}\n", jnd.compared.reference_g, one.jnd_g);
  return block + "END\n";
}

bool any_censored(std::span<const ReferenceJnd> jnds, Censored censored) {
  return std::ranges::any_of(jnds, [&](const auto& jnd) { return jnd.n_censored(censored) > 0; });
}

// Arrows point to where the JND is.
std::string censored_plots(std::span<const ReferenceJnd> jnds) {
  std::string plots;
  const auto add = [&](std::string_view block, Censored censored, int point_type,
                       std::string_view meaning) {
    if (any_censored(jnds, censored))
      plots += fmt::format(
          "${} using ($1+dx*{}):2 with points pointtype {} pointsize 0.8 linecolor '#5b7ea3' "
          "title '{}', ",
          block, participants_dx, point_type, meaning);
  };
  add("above", Censored::above, 8, "> this");
  add("below", Censored::below, 10, "< this");
  return plots;
}

bool any_mean(std::span<const ReferenceJnd> jnds) {
  return std::ranges::any_of(jnds, [](const auto& jnd) { return jnd.mean_g.has_value(); });
}

std::string measured_plot(std::span<const ReferenceJnd> jnds, int n) {
  if (!any_mean(jnds)) return "";
  return fmt::format(
      "$measured using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.9 linewidth 1.8 linecolor "
      "'#2f6fb0' title 'mean (n = {})', ",
      n);
}

std::string published_block(std::span<const ReferenceJnd> jnds) {
  std::string block = "$published << END\n";
  for (const ReferenceJnd& jnd : jnds)
    if (jnd.published_g)
      block += interval_line(
          jnd.compared.reference_g, *jnd.published_g,
          student_t_interval(*jnd.published_g, *jnd.published_sd_g, published::n_participants));
  return block + "END\n";
}

std::string published_plot(std::span<const ReferenceJnd> jnds) {
  if (std::ranges::none_of(jnds, [](const auto& jnd) { return jnd.published_g.has_value(); }))
    return "";
  return fmt::format(
      "$published using ($1+dx*{}):2:3:4 with yerrorbars pointtype 13 pointsize 1.2 linewidth "
      "1.4 linecolor '{}' title 'published (n = {})', ",
      published_dx, published_color, published::n_participants);
}

int most_participants(std::span<const ReferenceJnd> jnds) {
  int most = 0;
  for (const ReferenceJnd& jnd : jnds) most = std::max(most, jnd.n());
  return most;
}
}  // namespace

Chart jnd_chart(const Summary& summary) {
  Chart chart{"jnd", titled("JND against reference mass, 95 % intervals", summary), ""};
  const std::vector<ReferenceJnd> jnds = drawn(summary);
  if (jnds.empty()) return chart;
  chart.caption =
      "The paper's JND, which moves with the criterion and the start as much as with what is "
      "perceived. Large points: mean over participants where more than half have an exact JND; "
      "arrows: participants of whom it is known only to lie above or below; diamonds: published.";
  chart.n = most_participants(jnds);
  chart.csv = "jnd.csv";
  const double span_g = 1.1 * jnds.back().compared.reference_g + 10;
  chart.script =
      gnuplot_header({"jnd.svg", 860, 540, chart.title, caption_of(summary)}) +
      measured_block(jnds) + participants_block(jnds, "participants", Censored::none) +
      participants_block(jnds, "above", Censored::above) +
      participants_block(jnds, "below", Censored::below) + published_block(jnds) +
      fmt::format(
          "set key at screen 0.5, screen 1-40*pixel center top horizontal maxrows 1 samplen 2\n"
          "set tmargin at screen 1-80*pixel\n"
          "set bmargin at screen caption_top + 66*pixel\n"
          "dx = {}\n"
          "set xrange [-dx*0.03:dx]\nset yrange [0:*]\n"
          "set xlabel 'reference mass (g)'\nset ylabel 'JND (g)'\n"
          "plot {}{}{}$participants using ($1+dx*{}):2 with points pointtype 7 pointsize 0.45 "
          "linecolor '#9bb8d6' title 'each participant'\n",
          span_g, censored_plots(jnds), measured_plot(jnds, most_participants(jnds)),
          published_plot(jnds), participants_dx);
  return chart;
}

}  // namespace heft
