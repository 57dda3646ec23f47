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
    if (jnd.mean_g && jnd.compared.condition == "C2") jnds.push_back(jnd);
  return jnds;
}

std::string interval_line(double reference_g, double mean_g, const Interval& interval) {
  return fmt::format("{} {} {} {}\n", reference_g, mean_g, interval.low, interval.high);
}

std::string measured_block(std::span<const ReferenceJnd> jnds) {
  std::string block = "$measured << END\n";
  for (const ReferenceJnd& jnd : jnds)
    block += interval_line(jnd.compared.reference_g, *jnd.mean_g,
                           jnd.interval_g.value_or(Interval{*jnd.mean_g, *jnd.mean_g}));
  return block + "END\n";
}

std::string participants_block(std::span<const ReferenceJnd> jnds) {
  std::string block = "$participants << END\n";
  for (const ReferenceJnd& jnd : jnds)
    for (const ParticipantJnd& one : jnd.participants)
      block += fmt::format("{} {}\n", jnd.compared.reference_g, one.jnd_g);
  return block + "END\n";
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
      ", $published using ($1+dx*{}):2:3:4 with yerrorbars pointtype 13 pointsize 1.2 linewidth "
      "1.4 linecolor '{}' title 'published (n = {})'",
      published_dx, published_color, published::n_participants);
}

std::size_t most_participants(std::span<const ReferenceJnd> jnds) {
  std::size_t most = 0;
  for (const ReferenceJnd& jnd : jnds) most = std::max(most, jnd.participants.size());
  return most;
}
}  // namespace

Chart jnd_chart(const Summary& summary) {
  Chart chart{"jnd", titled("JND against reference mass, 95 % intervals", summary), ""};
  const std::vector<ReferenceJnd> jnds = drawn(summary);
  if (jnds.empty()) return chart;
  const double span_g = 1.1 * jnds.back().compared.reference_g + 10;
  chart.script =
      gnuplot_header({"jnd.svg", 860, 540, chart.title, caption_of(summary)}) +
      measured_block(jnds) + participants_block(jnds) + published_block(jnds) +
      fmt::format(
          "set key at screen 0.5, screen 1-40*pixel center top horizontal maxrows 1 samplen 2\n"
          "set tmargin at screen 1-80*pixel\n"
          "set bmargin at screen caption_top + 66*pixel\n"
          "dx = {}\n"
          "set xrange [-dx*0.03:dx]\nset yrange [0:*]\n"
          "set xlabel 'reference mass (g)'\nset ylabel 'JND (g)'\n"
          "plot $participants using ($1+dx*{}):2 with points pointtype 7 pointsize 0.45 "
          "linecolor '#9bb8d6' title 'each participant', "
          "$measured using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.9 linewidth "
          "1.8 linecolor '#2f6fb0' title 'mean (n = {})'{}\n",
          span_g, participants_dx, most_participants(jnds), published_plot(jnds));
  return chart;
}

}  // namespace heft
