// heft tune: the spring, or another technique, for a lab's range of masses.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "population/ResponderFit.h"
#include "population/Tuning.h"

namespace heft::cli {

namespace {
using nlohmann::ordered_json;

constexpr int n_springs = 7, n_masses = 4;

struct Ends {
  double low = 0, high = 0;
};

struct TuneOptions {
  std::string protocol, chart;
  Ends range_g, stiffness_n_per_m{10, 1000};
  std::optional<ResponderChoice> model;
  std::vector<ProtocolSetting> set;
  int repeats = 100;
  int jobs = 1;
  std::optional<std::uint64_t> seed;
  bool json = false;
};

Ends read_ends(const std::string& option, const std::string& text, const std::string& unit) {
  if (const auto range = positive_range_in(text, unit)) return {range->first, range->second};
  throw Error(fmt::format("{} {}: expected two numbers above 0, the smaller one first, such as "
                          "10{}..1000{}",
                          option, text, unit, unit),
              ExitCode::usage);
}

std::string percent(const ThresholdAtMass& one) {
  return one.threshold_g ? fmt::format("{:.0f} %", 100 * one.ratio()) : "-";
}

void print_row(const TunedTechnique& one, const std::string& name) {
  print("{:<20}", name);
  for (const ThresholdAtMass& mass : one.masses) print(" {:>9}", percent(mass));
  const auto worst = one.worst();
  print(" {:>9}\n", worst ? fmt::format("{:.0f} %", 100 * *worst) : "-");
}

// What to write into a protocol.
std::string snippet_of(const Technique& technique, bool is_declared) {
  if (is_declared)
    return fmt::format(
        "condition = \"{}\"    # of your blocks; declared as in the protocol given\n",
        technique.name);
  return fmt::format(
      "[coupling]\nstiffness_n_per_m = {:g}    # condition = \"C2\" of your blocks\n",
      std::get<Coupling>(technique.law).stiffness_n_per_m);
}

void print_tuning(const std::vector<TunedTechnique>& all, const TunedTechnique* best,
                  const std::optional<TunedTechnique>& whole, bool is_declared) {
  print("75 % threshold of a forced choice, in % of the mass\n\n{:<20}", "technique");
  for (const ThresholdAtMass& mass : all.front().masses)
    print(" {:>9}", fmt::format("{:g} g", mass.mass_g));
  print(" {:>9}\n", "worst");
  for (const TunedTechnique& one : all) print_row(one, one.technique.name);
  if (!best)
    return print(
        "\nNo technique has a threshold at every mass: try a smaller --range or softer "
        "springs (--stiffness).\n");
  if (whole) {
    print("\nBest, by whole sessions instead of straight strokes:\n");
    print_row(*whole, whole->technique.name);
  }
  print("\n{}", snippet_of(best->technique, is_declared));
  print("\nThis holds for people of this model.\nNext: heft power PROTOCOL, with such masses.\n");
}

std::string as_json(const std::vector<TunedTechnique>& all, const TunedTechnique* best,
                    const std::optional<TunedTechnique>& whole, std::uint64_t seed) {
  const auto value = [](const std::optional<double>& of) {
    return of ? ordered_json(*of) : ordered_json();
  };
  const auto object_of = [&](const TunedTechnique& one) {
    ordered_json masses = ordered_json::array();
    for (const ThresholdAtMass& mass : one.masses)
      masses.push_back({{"mass_g", mass.mass_g},
                        {"threshold_g", value(mass.threshold_g)},
                        {"low_g", value(mass.low_g)},
                        {"high_g", value(mass.high_g)},
                        {"why", mass.why}});
    return ordered_json{
        {"technique", one.technique.name}, {"worst", value(one.worst())}, {"masses", masses}};
  };
  ordered_json root{{"seed", seed}, {"techniques", ordered_json::array()}};
  for (const TunedTechnique& one : all) root["techniques"].push_back(object_of(one));
  root["best"] = best ? ordered_json(best->technique.name) : ordered_json();
  root["whole"] = whole ? object_of(*whole) : ordered_json();
  return root.dump(2) + "\n";
}

void tune(const TuneOptions& options) {
  const std::uint64_t seed = options.seed ? *options.seed : 1;
  const std::string protocol =
      options.protocol.empty() ? installed_file("protocols/paper.toml") : options.protocol;
  TuningRequest request{
      load_protocol(protocol, options.set), {}, {}, {}, options.repeats, options.jobs, seed};
  request.session.responder = options.model.value_or(Plug{"simulated"});
  request.session.tracker = Plug{"surrogate"};
  request.session.protocol_file = protocol;
  request.techniques =
      springs_between(options.stiffness_n_per_m.low, options.stiffness_n_per_m.high, n_springs,
                      request.protocol.coupling);
  for (const Technique& declared : request.protocol.techniques)
    request.techniques.push_back(declared);
  request.masses_g = masses_between(options.range_g.low, options.range_g.high, n_masses);

  const StopOnSignal stop;
  const auto run = [&](const TuningRequest& of, const char* what) {
    ProgressBar bar(what);
    auto found = thresholds_of(
        of, [&](double done) { bar.update(done, ""); }, stop.requested());
    if (!found) throw Error("stopped before the last technique", ExitCode::interrupted);
    return std::move(*found);
  };
  const std::vector<TunedTechnique> all = run(request, "techniques");
  const TunedTechnique* best = best_of(all);
  std::optional<TunedTechnique> whole;
  if (best) {
    TuningRequest confirming = request;
    confirming.session.tracker = Plug{"hand"};
    confirming.techniques = {best->technique};
    whole = run(confirming, "whole sessions").front();
  }
  if (!options.chart.empty()) draw_tuning(all, best, seed, options.chart);
  if (options.json) return fmt::print("{}", as_json(all, best, whole, seed));
  const bool is_declared = best && std::ranges::count(request.protocol.techniques,
                                                      best->technique.name, &Technique::name);
  print_tuning(all, best, whole, is_declared);
  if (!options.chart.empty()) print("chart: {}\n", options.chart);
}

}  // namespace

void add_tune(Command& app) {
  const auto options = std::make_shared<TuneOptions>();
  Command command = app.add_command(
      "tune", "the stiffness or technique for a range of masses",
      {"heft tune --range 10g..1000g", "heft tune mine.toml --range 50g..400g --chart tune.svg"});
  command.is_minor();
  command.add_option("PROTOCOL", &options->protocol,
                     "a protocol file: its layout, physics and declared techniques (default: the "
                     "paper's)");
  command
      .add_option("--range", ReadsText{[options](const std::string& text) {
                    options->range_g = read_ends("--range", text, "g");
                  }},
                  "LOW..HIGH: the masses, such as 10g..1000g")
      .required();
  command.add_option("--stiffness", ReadsText{[options](const std::string& text) {
                       options->stiffness_n_per_m = read_ends("--stiffness", text, "");
                     }},
                     "LOW..HIGH: of the springs to try, N/m (default: 10..1000)");
  add_responder(command, options->model, "NAME:FILE, who judges (default: simulated)");
  command.add_option("--repeats", &options->repeats, "answers to each of 11 differences")
      .shows_default()
      .whole_number(10, 10'000);
  command.add_jobs(options->jobs, "the result does");
  command.add_seed(options->seed, "1");
  command.add_option("--chart", &options->chart, "FILE.svg: thresholds against mass");
  command.add_flag("--json", options->json, "all figures as JSON on stdout");
  add_settings(command, options->set, "change a key of the protocol, such as physics.friction=0.5");
  command.does([options] {
    if (!options->chart.empty() && !options->chart.ends_with(".svg"))
      throw Error("--chart: expected a file that ends in .svg", ExitCode::usage);
    tune(*options);
  });
}

}  // namespace heft::cli
