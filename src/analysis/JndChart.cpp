// JND against reference mass: participants, mean with interval, and the paper's.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/Published.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr double published_dx = 0.045;  // of the x axis

std::vector<ReferenceJnd> drawn(const Summary& summary) {
  std::vector<ReferenceJnd> jnds;
  for (const ReferenceJnd& jnd : summary.jnd)
    if (jnd.n() > 0 && jnd.compared.condition == "C2") jnds.push_back(jnd);
  return jnds;
}

// One start's JNDs at one reference.
struct Group {
  double reference_g = 0;
  StartedJnds jnds;
};

// What is drawn alike; at a reference they stand side by side.
struct Series {
  std::string name, meaning;
  double mean_dx, people_dx;
  int point_type;
  std::vector<Group> groups{};
};

std::vector<Series> series_of(std::span<const ReferenceJnd> jnds) {
  Series all{"all", "mean", 0, -0.022, 7};
  Series above{"above", "mean from above", -0.012, -0.026, 5};
  Series below{"below", "mean from below", 0.012, 0.026, 4};
  for (const ReferenceJnd& jnd : jnds) {
    const double at_g = jnd.compared.reference_g;
    if (!jnd.starts) {
      all.groups.push_back({at_g, jnd.as_published()});
      continue;
    }
    above.groups.push_back({at_g, jnd.starts->from_above_g});
    below.groups.push_back({at_g, jnd.starts->from_below_g});
  }
  std::vector<Series> series{all, above, below};
  std::erase_if(series, [](const Series& one) { return one.groups.empty(); });
  return series;
}

std::string interval_line(double reference_g, double mean_g, const Interval& interval) {
  return fmt::format("{} {} {} {}\n", reference_g, mean_g, interval.low, interval.high);
}

std::string block(const std::string& name, const std::string& rows) {
  return fmt::format("${} << END\n{}END\n", name, rows);
}

// The data of each, and how it is plotted. Of censored people arrows point to where the JND is.
struct Drawing {
  std::string blocks, plots;

  void add(const std::string& name, const std::string& rows, const std::string& how) {
    if (rows.empty()) return;
    blocks += block(name, rows);
    plots += fmt::format("{}${} {}", plots.empty() ? "" : ", ", name, how);
  }
};

struct PeopleLook {
  Censored censored;
  std::string_view name, meaning, look;
};
constexpr std::array people_looks{
    PeopleLook{Censored::none, "exact", "each participant", "pointtype 7 pointsize 0.45"},
    PeopleLook{Censored::above, "more", "> this", "pointtype 8 pointsize 0.8"},
    PeopleLook{Censored::below, "less", "< this", "pointtype 10 pointsize 0.8"}};

std::string people_rows(const Series& series, Censored censored) {
  std::string rows;
  for (const Group& group : series.groups)
    for (const ParticipantJnd& one : group.jnds.participants)
      if (one.censored == censored) rows += fmt::format("{} {}\n", group.reference_g, one.jnd_g);
  return rows;
}

void add_people(Drawing& drawing, std::span<const Series> all) {
  for (const PeopleLook& look : people_looks) {
    bool told = false;  // in the key
    for (const Series& series : all) {
      const std::string rows = people_rows(series, look.censored);
      drawing.add(
          fmt::format("{}_{}", series.name, look.name), rows,
          fmt::format("using ($1+dx*{}):2 with points {} linecolor '#7f9cbb' {}", series.people_dx,
                      look.look, told ? "notitle" : fmt::format("title '{}'", look.meaning)));
      told = told || !rows.empty();
    }
  }
}

void add_means(Drawing& drawing, const Series& series) {
  std::string rows;
  int n = 0;
  for (const auto& [reference_g, jnds] : series.groups) {
    n = std::max(n, jnds.n());
    if (jnds.mean)
      rows += interval_line(reference_g, *jnds.mean,
                            jnds.interval.value_or(Interval{*jnds.mean, *jnds.mean}));
  }
  drawing.add(series.name + "_mean", rows,
              fmt::format("using ($1+dx*{}):2:3:4 with yerrorbars pointtype {} pointsize 0.9 "
                          "linewidth 1.8 linecolor '#2f6fb0' title '{} (n = {})'",
                          series.mean_dx, series.point_type, series.meaning, n));
}

void add_published(Drawing& drawing, std::span<const ReferenceJnd> jnds) {
  std::string rows;
  for (const ReferenceJnd& jnd : jnds)
    if (jnd.published_g)
      rows += interval_line(
          jnd.compared.reference_g, *jnd.published_g,
          student_t_interval(*jnd.published_g, *jnd.published_sd_g, published::n_participants));
  drawing.add("published", rows,
              fmt::format("using ($1+dx*{}):2:3:4 with yerrorbars pointtype 13 pointsize 1.2 "
                          "linewidth 1.4 linecolor '{}' title 'published (n = {})'",
                          published_dx, published_color, published::n_participants));
}
}  // namespace

Chart jnd_chart(const Summary& summary) {
  Chart chart{"jnd", titled("JND against reference mass, 95 % intervals", summary), ""};
  const std::vector<ReferenceJnd> jnds = drawn(summary);
  if (jnds.empty()) return chart;
  chart.caption =
      "The paper's JND, which moves with the criterion and the start as much as with what is "
      "perceived; of staircases from above (filled squares, to the left) and from below (open "
      "squares, to the right) apart. Large points: mean over participants where more than half "
      "have an exact JND; arrows: participants of whom it is known only to lie above or below; "
      "diamonds: published, of staircases from above.";
  for (const ReferenceJnd& jnd : jnds) chart.n = std::max(chart.n, jnd.n());
  chart.csv = "jnd.csv";
  Drawing drawing;
  const std::vector<Series> all = series_of(jnds);
  add_people(drawing, all);
  for (const Series& series : all) add_means(drawing, series);
  add_published(drawing, jnds);
  const double span_g = 1.1 * jnds.back().compared.reference_g + 10;
  chart.script = gnuplot_header({"jnd.svg", 860, 540, chart.title, caption_of(summary)}) +
                 drawing.blocks +
                 fmt::format(
                     "set key at screen 0.5, screen 1-40*pixel center top horizontal maxrows 3 "
                     "samplen 2\n"
                     "set tmargin at screen 1-112*pixel\n"
                     "set bmargin at screen caption_top + 66*pixel\n"
                     "dx = {}\n"
                     "set xrange [-dx*0.06:dx]\nset yrange [0:*]\n"
                     "set xlabel 'reference mass (g)'\nset ylabel 'JND (g)'\n"
                     "plot {}\n",
                     span_g, drawing.plots.empty() ? "NaN notitle" : drawing.plots);
  return chart;
}

}  // namespace heft
