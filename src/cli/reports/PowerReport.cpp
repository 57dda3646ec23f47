// What a study can be expected to find: tables, sentences, JSON and a chart.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/charts/Plot.h"
#include "analysis/display/Phrases.h"
#include "analysis/display/Table.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "population/Power.h"

namespace heft::cli {

namespace {
using nlohmann::ordered_json;
using namespace std::string_view_literals;

constexpr double wanted_power = 0.8;
constexpr std::size_t most_columns = 3;  // of the first screen
constexpr std::size_t most_rows = 10;    // of its figures
constexpr std::size_t name_width = 20;
constexpr std::size_t screen_width = 80;

double share_of(const HypothesisPower& power) {
  return power.supported.percent() / 100;
}

std::string name_of(const EstimatePrecision& one) {
  std::string text(one.place.measure->heading);
  if (!one.place.task.empty() && one.place.task != "comparison") text += ", " + one.place.task;
  if (!one.place.condition.empty()) text += fmt::format(" {}", one.place.condition);
  if (one.place.reference_g) text += fmt::format(" {:g} g", *one.place.reference_g);
  return text;
}

std::string full_name_of(const EstimatePrecision& one) {
  std::string text = name_of(one);
  for (const Coordinate& at : one.place.by) text += ", " + at.text;
  return text;
}

bool is_correct_sorting(const EstimatePrecision& one) {
  return one.place.measure->name == "sorting_answers" && one.place.text_at("trials") == "all" &&
         one.place.text_at("answer") == "correct";
}

bool is_main(const EstimatePrecision& one) {
  constexpr std::array names{"threshold_75"sv,        "jnd"sv,
                             "forced_threshold_75"sv, "same_different_threshold_75"sv,
                             "judgment_threshold"sv,  "judgment_mean"sv,
                             "estimation_exponent"sv, "adjustment_bias_percent"sv};
  return std::ranges::count(names, one.place.measure->name) > 0;
}

// In g, and positive: it can be compared as a ratio.
bool is_main_mass(const EstimatePrecision& one) {
  return is_main(one) && one.place.measure->unit == "g";
}

// Of comparisons the variants of a figure have the same name, and the first one is enough.
std::string short_name_of(const EstimatePrecision& one) {
  return one.place.task == "comparison" ? name_of(one) : full_name_of(one);
}

// The figures of the first screen. Sortings are in the hypotheses where these are the paper's.
std::vector<const EstimatePrecision*> main_figures(const PowerAtSize& size) {
  std::vector<const EstimatePrecision*> figures;
  for (const EstimatePrecision& one : size.estimates)
    if (is_main(one) && (figures.empty() || short_name_of(*figures.back()) != short_name_of(one)))
      figures.push_back(&one);
  if (figures.empty())
    for (const EstimatePrecision& one : size.estimates)
      if (is_correct_sorting(one)) figures.push_back(&one);
  return figures;
}

// A name that is too long for its column takes a separate line.
void print_name(const std::string& name) {
  if (name.size() > name_width)
    print("{}\n{:<{}}", name, "", name_width);
  else
    print("{:<{}}", name, name_width);
}

bool is_same(const EstimatePrecision& a, const EstimatePrecision& b) {
  return a.place.measure == b.place.measure && a.place.task == b.place.task &&
         a.place.condition == b.place.condition && a.place.reference_g == b.place.reference_g &&
         full_name_of(a) == full_name_of(b);
}

const EstimatePrecision* at_size(const PowerAtSize& size, const EstimatePrecision& one) {
  const auto found = std::ranges::find_if(
      size.estimates, [&](const EstimatePrecision& other) { return is_same(one, other); });
  return found == size.estimates.end() ? nullptr : &*found;
}

const HypothesisPower* at_size(const PowerAtSize& size, const std::string& name) {
  const auto found = std::ranges::find(size.hypotheses, name, &HypothesisPower::name);
  return found == size.hypotheses.end() ? nullptr : &*found;
}

// The smallest, a middle and the largest size. Whole sessions follow the surrogates of their size.
std::vector<const PowerAtSize*> columns_of(const ModelPower& found, bool tables) {
  const std::vector<PowerAtSize>& sizes = found.power.sizes;
  std::vector<const PowerAtSize*> columns;
  for (const PowerAtSize& size : sizes) {
    columns.push_back(&size);
    if (found.whole && found.whole->participants == size.participants)
      columns.push_back(&*found.whole);
  }
  if (tables || columns.size() <= most_columns) return columns;
  if (!found.whole) return {columns.front(), columns[columns.size() / 2], columns.back()};
  const auto whole = std::ranges::find(columns, &*found.whole);
  if (whole == columns.end() - 1) return {columns.front(), *(whole - 1), *whole};
  return {*(whole - 1), *whole, columns.back()};
}

std::string cell(const HypothesisPower* power) {
  if (!power) return "-";
  if (!power->is_tested) return "not tested";
  return fmt::format("{:.0f} % [{:.0f}, {:.0f}]", 100 * share_of(*power), 100 * power->interval.low,
                     100 * power->interval.high);
}

std::string cell(const EstimatePrecision* one) {
  if (!one || one->printed.n_hits == 0) return "none";
  const char* often = one->printed.n_hits == one->printed.n_trials ? "" : "*";
  return fmt::format("{} [{}, {}]{}", in_digits(one->median_value), in_digits(one->median_low),
                     in_digits(one->median_high), often);
}

void print_table(const ModelPower& found, bool tables) {
  const auto columns = columns_of(found, tables);
  const PowerAtSize& largest = found.power.sizes.back();
  const auto head = [&](const char* what) {
    print("\n{:<{}}", what, name_width);
    for (const PowerAtSize* size : columns)
      print(" {:>19}", fmt::format("{} {}", size->participants,
                                   found.whole && size == &*found.whole ? "whole" : "people"));
    print("\n");
  };
  if (!largest.hypotheses.empty()) head("hypothesis supported");
  for (const HypothesisPower& one : largest.hypotheses) {
    print_name(one.name + (one.declared ? " (declared)" : ""));
    for (const PowerAtSize* size : columns) print(" {:>19}", cell(at_size(*size, one.name)));
    print("\n");
  }
  std::vector<const EstimatePrecision*> figures = main_figures(largest);
  if (tables) {
    figures.clear();
    for (const EstimatePrecision& one : largest.estimates)
      if (one.printed.n_hits > 0 || is_main(one)) figures.push_back(&one);
  }
  const std::size_t n_left_out =
      tables || figures.size() <= most_rows ? 0 : figures.size() - most_rows;
  figures.resize(figures.size() - n_left_out);
  if (!figures.empty()) head("figure [interval]");
  for (const EstimatePrecision* one : figures) {
    print_name(tables ? full_name_of(*one) : short_name_of(*one));
    for (const PowerAtSize* size : columns) print(" {:>19}", cell(at_size(*size, *one)));
    print("\n");
  }
  if (n_left_out > 0) print("{} more: --tables\n", n_left_out);
}

// Which hypotheses the largest study is likely to support.
std::string sentence_of_hypotheses(const PowerAtSize& size) {
  std::vector<std::string> likely, unlikely, untested;
  for (const HypothesisPower& one : size.hypotheses)
    (!one.is_tested                  ? untested
     : share_of(one) >= wanted_power ? likely
                                     : unlikely)
        .push_back(one.name);
  const std::string cannot =
      untested.empty() ? ""
                       : fmt::format("\nDeclared, but this protocol does not test it: {}.",
                                     fmt::join(untested, ", "));
  if (likely.empty())
    return fmt::format("With {} people, no hypothesis is supported in {:.0f} % of studies.{}",
                       size.participants, 100 * wanted_power, cannot);
  std::string text = fmt::format("With {} people, at least {:.0f} % of studies support {}.",
                                 size.participants, 100 * wanted_power, fmt::join(likely, ", "));
  if (!unlikely.empty()) text += fmt::format("\nFewer support {}.", fmt::join(unlikely, ", "));
  return text + cannot;
}

std::string sentence_of_precision(const PowerAtSize& size) {
  const EstimatePrecision* widest = nullptr;
  const auto factor = [](const EstimatePrecision& one) {
    return std::sqrt(one.median_high / one.median_low);
  };
  for (const EstimatePrecision& one : size.estimates)
    if (is_main_mass(one) && one.printed.n_hits > 0 && one.median_low > 0 &&
        (!widest || factor(one) > factor(*widest)))
      widest = &one;
  if (!widest) return "";
  const std::string text = fmt::format(
      "Least certain with {} people: {}, to within a factor of {} (printed in {:.0f} % of "
      "studies).",
      size.participants, short_name_of(*widest), in_digits(factor(*widest)),
      widest->printed.percent());
  return fmt::format("{}\n", fmt::join(heft::wrapped(text, screen_width), "\n"));
}

ordered_json object_of(const HypothesisPower& one) {
  return {{"hypothesis", one.name},
          {"statement", one.statement},
          {"declared", one.declared},
          {"tested", one.is_tested},
          {"supported", share_of(one)},
          {"supported_interval", {one.interval.low, one.interval.high}},
          {"not_supported", one.not_supported.percent() / 100},
          {"inconclusive", one.inconclusive.percent() / 100}};
}

ordered_json object_of(const EstimatePrecision& one) {
  const bool any = one.printed.n_hits > 0;
  ordered_json by = ordered_json::object();
  for (const Coordinate& at : one.place.by) by[std::string(at.name)] = at.text;
  const auto number = [&](double value) {
    return any ? ordered_json(value) : ordered_json(nullptr);
  };
  return {{"measure", one.place.measure->name},
          {"unit", one.place.measure->unit},
          {"task", one.place.task},
          {"condition", one.place.condition},
          {"by", by},
          {"reference_g",
           one.place.reference_g ? ordered_json(*one.place.reference_g) : ordered_json(nullptr)},
          {"printed", one.printed.percent() / 100},
          {"value", number(one.median_value)},
          {"low", number(one.median_low)},
          {"high", number(one.median_high)},
          {"sd_over_studies", one.sd ? ordered_json(*one.sd) : ordered_json(nullptr)}};
}

// Series are drawn side by side, since many are equal.
std::string lines_of(const std::vector<std::string>& names, const std::string& prefix,
                     int largest) {
  const auto aside_of = [largest](std::size_t i, std::size_t n) {
    return 0.012 * largest * (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1));
  };
  std::string terms;
  for (std::size_t i = 0; i < names.size(); ++i)
    terms += fmt::format(
        "{}${}{} using ($1+{}):2:3:4 with yerrorlines pointtype {} pointsize 0.8 linewidth 1.5 "
        "linecolor '{}' title {}",
        i == 0 ? "" : ", ", prefix, i, aside_of(i, names.size()), series_sign(i), series_color(i),
        gnuplot_quoted(names[i]));
  return terms;
}

}  // namespace

void print_power(const ModelPower& found, bool tables) {
  const Power& power = found.power;
  const std::string heading =
      fmt::format("protocol {}, model {}: {} simulated studies of each size (--seed {})",
                  found.protocol, found.model, power.n_studies, found.seed);
  heft::cli::print("{}\n", fmt::join(heft::wrapped(heading, screen_width), "\n"));
  print_table(found, tables);
  print("\n");
  if (!power.sizes.back().hypotheses.empty())
    print("{}\n", sentence_of_hypotheses(power.sizes.back()));
  print("{}", sentence_of_precision(power.sizes.back()));
  if (found.whole) print("whole: the same studies by whole sessions (--level hand)\n");
  print(
      "Figures and interval ends are medians over studies; *: not in all of them.\n"
      "They hold for people of this model: repeat with others (--model).{}\n",
      tables ? "" : "\nAll sizes and figures: --tables");
}

std::string as_json(const std::vector<ModelPower>& all) {
  ordered_json models = ordered_json::array();
  for (const ModelPower& found : all) {
    ordered_json sizes = ordered_json::array();
    const auto put = [&sizes](const PowerAtSize& size, const std::string& level) {
      ordered_json hypotheses = ordered_json::array(), estimates = hypotheses;
      for (const HypothesisPower& one : size.hypotheses) hypotheses.push_back(object_of(one));
      for (const EstimatePrecision& one : size.estimates) estimates.push_back(object_of(one));
      sizes.push_back({{"participants", size.participants},
                       {"level", level},
                       {"hypotheses", hypotheses},
                       {"estimates", estimates}});
    };
    for (const PowerAtSize& size : found.power.sizes) put(size, found.level);
    if (found.whole) put(*found.whole, "hand");
    models.push_back({{"protocol", found.protocol},
                      {"model", found.model},
                      {"seed", found.seed},
                      {"n_studies", found.power.n_studies},
                      {"sizes", sizes}});
  }
  return ordered_json{{"models", models}}.dump(2) + "\n";
}

namespace {
// Blocks of gnuplot's data, $h0, $h1... for the letter h, and the names of what they hold.
struct ChartData {
  char letter;
  std::vector<std::string> names = {};
  std::string text = {};

  void add(const std::string& name, const std::string& rows) {
    text += fmt::format("${}{} << END\n{}END\n", letter, names.size(), rows);
    names.push_back(name);
  }
};

ChartData data_of_hypotheses(const Power& power) {
  ChartData data{'h'};
  for (const HypothesisPower& one : power.sizes.back().hypotheses) {
    std::string rows;
    for (const PowerAtSize& size : power.sizes)
      if (const HypothesisPower* at = at_size(size, one.name))
        rows += fmt::format("{} {} {} {}\n", size.participants, 100 * share_of(*at),
                            100 * at->interval.low, 100 * at->interval.high);
    data.add(one.name, rows);
  }
  return data;
}

ChartData data_of_figures(const Power& power) {
  ChartData data{'f'};
  for (const EstimatePrecision& one : power.sizes.back().estimates) {
    if (!is_main_mass(one) || one.printed.n_hits == 0) continue;
    std::string rows;
    for (const PowerAtSize& size : power.sizes)
      if (const EstimatePrecision* at = at_size(size, one); at && at->printed.n_hits > 0)
        rows += fmt::format("{} {} {} {}\n", size.participants, at->median_value, at->median_low,
                            at->median_high);
    data.add(short_name_of(one), rows);
  }
  return data;
}
}  // namespace

void draw_power(const ModelPower& found, const std::string& file) {
  constexpr int width_px = 900, plot_px = 330, bottom_px = 110, key_line_px = 18;
  const Power& power = found.power;
  const ChartData hypotheses = data_of_hypotheses(power), figures = data_of_figures(power);
  const bool has_hypotheses = !hypotheses.names.empty(), has_figures = !figures.names.empty();
  const bool has_both = has_hypotheses && has_figures;
  const std::string shown =
      has_both ? "Left: with exact 95 % intervals; dotted: 80 %. Right: median figure and median "
                 "interval."
      : has_hypotheses ? "Exact 95 % intervals; dotted: 80 %."
                       : "Median figure and median interval.";
  const int largest = power.sizes.back().participants;
  const int n_keys = static_cast<int>(std::max(hypotheses.names.size(), figures.names.size()));
  const int top_px = 50 + key_line_px * n_keys;
  const auto panel = [&](double left, double right, const std::string& axes,
                         const std::string& terms) {
    return gnuplot_place(left, right, top_px, top_px + plot_px) +
           fmt::format(
               "set key at screen {}, screen 1-34*pixel center top horizontal maxcols {} "
               "samplen 1.5 font ',11'\nset xlabel 'participants in the study'\n"
               "set xrange [0:{}]\n{}plot {}\n",
               (left + right) / 2, has_both ? 2 : 1, 1.05 * largest + 1, axes, terms) +
           "unset label\n";
  };
  draw_svg(file, [&](const std::string& svg) {
    return gnuplot_header({svg, width_px, top_px + plot_px + bottom_px,
                           fmt::format("What a study of {} can find", found.protocol),
                           fmt::format("{} simulated studies with people of the model \"{}\". {} "
                                       "Made by: heft power (seed {})",
                                       power.n_studies, found.model, shown, found.seed)}) +
           hypotheses.text + figures.text + "set multiplot\n" +
           (has_hypotheses
                ? panel(0.1, has_both ? 0.47 : 0.97,
                        "set ylabel '% of studies that support it'\nset yrange [0:100]\n",
                        "80 with lines dashtype 3 linecolor '#999999' notitle, " +
                            lines_of(hypotheses.names, "h", largest))
                : "") +
           (has_figures ? panel(has_both ? 0.59 : 0.1, 0.97,
                                "set ylabel 'g'\nset logscale y\nset yrange [*:*]\n",
                                lines_of(figures.names, "f", largest))
                        : "") +
           "unset multiplot\n";
  });
}

}  // namespace heft::cli
