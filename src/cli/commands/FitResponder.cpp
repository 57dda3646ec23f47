// heft fit-responder: the population of simulated participants behind reported figures or a log.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "analysis/display/Phrases.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "population/ResponderFit.h"
#include "responders/ResponderParameters.h"

namespace heft::cli {

namespace {
using nlohmann::ordered_json;

struct FitResponderOptions {
  std::string protocol, figures, db, save;
  std::optional<ResponderChoice> model;
  std::vector<FreeParameter> free;
  std::vector<ProtocolSetting> set;
  int people = 4000;
  int repeats = 40;
  int jobs = 1;
  std::optional<std::uint64_t> seed;
  bool json = false, unverified = false;

  const std::string& data() const { return db.empty() ? figures : db; }
};

// The bank's error must be small beside that of the reported figures.
constexpr int enough_per_person = 5;
constexpr int enough_for_answers = 10;

std::string interval_of(const FreeEstimate& one) {
  return fmt::format("[{}, {}]", one.low ? in_digits(*one.low) : "...",
                     one.high ? in_digits(*one.high) : "...");
}

std::string beside(std::optional<double> reported, std::optional<double> found,
                   std::optional<double> z) {
  const auto text = [](std::optional<double> value) {
    return value ? fmt::format("{:.1f}", *value) : "-";
  };
  return fmt::format("{:>8} {:>8} {:>6}", text(reported), text(found),
                     z ? fmt::format("{:+.1f}", *z) : "");
}

std::optional<double> if_any(const Bank::Moments& found, double value) {
  return found.exists() ? std::optional(value) : std::nullopt;
}

std::string_view role_of(const ComparedFigure& one) {
  if (!one.found.exists()) return "no one has it";
  if (!one.reported.mean) return "predicted";
  return one.reported.fitted ? "fitted" : "held out";
}

void print_parameters(const ResponderFit& fit) {
  print("{:<28} {:>9}  {:<20}\n", "parameter", "estimate", "95 % interval");
  for (const FreeEstimate& one : fit.parameters)
    print(
        "{:<28} {:>9}  {:<20} {}\n", one.free.name, in_digits(one.value), interval_of(one),
        one.identified() ? "" : fmt::format("open within {:g}..{:g}", one.free.low, one.free.high));
}

void print_figures(const ResponderFit& fit) {
  print("\n{:<26} {:>8} {:>8} {:>6}   {:>8} {:>8} {:>6}\n", "figure", "mean", "model", "z", "SD",
        "model", "z");
  for (const ComparedFigure& one : fit.figures)
    print("{:<26} {}   {}  {}\n",
          text_of(one.reported.place) + " (" + std::string(unit_of(one.reported.place.kind)) + ")",
          beside(one.reported.mean, if_any(one.found, one.found.mean), one.z_mean),
          beside(one.reported.sd, if_any(one.found, one.found.sd), one.z_sd), role_of(one));
  print("\nlog likelihood: fitted {:.2f} ({})", fit.fitted,
        fmt::format("{} means and SDs", fit.n_fitted));
  if (fit.n_held_out > 0)
    print(", held out {:.2f} ({})", fit.held_out, fmt::format("{} means and SDs", fit.n_held_out));
  print("\n");
}

void print_cautions(const ResponderFit& fit, int people, int n_least) {
  for (const ResponderFit::Pair& pair : fit.alike)
    print("the data hardly separate {} and {}: their estimates correlate by {:.2f}\n", pair.first,
          pair.second, pair.correlation);
  if (fit.effective < n_least)
    print(
        "caution: only {:.0f} of {} simulated participants are like {}; take more with --people, "
        "or narrower bounds\n",
        fit.effective, people, fit.figures.empty() ? "one of the people" : "this population");
}

// People in the bank for each one of the largest study.
int least_effective(const ResponderFit& fit) {
  int n_largest = 0;
  for (const ComparedFigure& one : fit.figures) n_largest = std::max(n_largest, one.reported.n);
  return enough_per_person * n_largest;
}

ordered_json json_of(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

std::string as_json(const ResponderFit& fit, int people, std::uint64_t seed) {
  ordered_json root{{"people", people},
                    {"seed", seed},
                    {"effective", fit.effective},
                    {"log_likelihood_fitted", fit.fitted},
                    {"log_likelihood_held_out", fit.held_out}};
  for (const FreeEstimate& one : fit.parameters)
    root["parameters"].push_back({{"name", one.free.name},
                                  {"estimate", one.value},
                                  {"low", json_of(one.low)},
                                  {"high", json_of(one.high)},
                                  {"bounds", {one.free.low, one.free.high}}});
  root["figures"] = ordered_json::array();
  for (const ComparedFigure& one : fit.figures)
    root["figures"].push_back({{"figure", name_of(one.reported.place.kind)},
                               {"reference_g", json_of(one.reported.place.reference_g)},
                               {"condition", one.reported.place.condition},
                               {"fitted", one.reported.fitted},
                               {"mean", json_of(one.reported.mean)},
                               {"model_mean", json_of(if_any(one.found, one.found.mean))},
                               {"z_mean", json_of(one.z_mean)},
                               {"sd", json_of(one.reported.sd)},
                               {"model_sd", json_of(if_any(one.found, one.found.sd))},
                               {"z_sd", json_of(one.z_sd)}});
  root["alike"] = ordered_json::array();
  for (const ResponderFit::Pair& pair : fit.alike)
    root["alike"].push_back({pair.first, pair.second, pair.correlation});
  return root.dump(2) + "\n";
}

// The model's file with the fitted values; other parameters are unchanged.
std::string model_file(const ResponderFit& fit, const ResponderOptions& given,
                       const FitResponderOptions& options) {
  std::string text = fmt::format("# Fitted by heft fit-responder to {}{}.\n", options.data(),
                                 options.db.empty() ? ", protocol " + options.protocol : "");
  const auto is_fitted = [&](std::string_view name) {
    return std::ranges::any_of(fit.parameters, [&](const FreeEstimate& one) {
      return one.free.name == without_median(name);
    });
  };
  for (const Parameter& one : given.parameters) {
    if (is_fitted(one.name)) continue;
    if (const auto* value = std::get_if<double>(&one.value))
      text += fmt::format("{} = {}\n", one.name, *value);
    else
      text += fmt::format("{} = \"{}\"\n", one.name, std::get<std::string>(one.value));
  }
  for (const FreeEstimate& one : fit.parameters) {
    const bool is_spread = one.free.name.ends_with(spread_ending);
    text += fmt::format("{}{} = {:.4g}\n", one.free.name, is_spread ? "" : ".median", one.value);
  }
  return text;
}

// @param protocol with the trials of the fit
ResolvedConfig config_of(const FitResponderOptions& options, const Protocol& protocol,
                         std::uint64_t seed) {
  SessionOptions given;
  given.responder = options.model.value_or(Plug{"simulated"});
  given.tracker = Plug{"surrogate"};
  given.settings = options.set;
  given.protocol_file = options.protocol;
  return resolve(given, protocol, seed);
}

Bank bank_of(const Bank::Request& request) {
  const StopOnSignal stop;
  ProgressBar bar("simulating people");
  const auto progress = [&](double done) {
    bar.update(done, fmt::format("{:.0f} of {} people", done * request.people, request.people));
  };
  auto bank = Bank::simulate(request, progress, stop.requested());
  if (!bank) throw Error("stopped before the last simulated person", ExitCode::interrupted);
  return std::move(*bank);
}

void save_and_advise(const FitResponderOptions& options, const ResponderFit& fit,
                     const Bank::Request& request) {
  if (options.save.empty()) return;
  replace_text_file(options.save, model_file(fit, request.config->model.options, options));
  say("model: {}; next: heft simulate {} --responder population:{}\n", options.save,
      options.db.empty() ? options.protocol : "PROTOCOL", options.save);
}

void fit_to_figures(const FitResponderOptions& options, std::uint64_t seed) {
  const std::vector<ReportedFigure> figures =
      parse_figures(read_text_file(options.figures), options.figures);
  Bank::Request request{config_of(options, load_protocol(options.protocol, options.set), seed),
                        options.free,
                        {},
                        options.people,
                        options.jobs};
  for (const ReportedFigure& figure : figures) request.places.push_back(figure.place);
  const ResponderFit fit = fit_responder(bank_of(request), figures);
  if (options.json) {
    fmt::print("{}", as_json(fit, options.people, seed));
  } else {
    print_parameters(fit);
    print_figures(fit);
    print_cautions(fit, options.people, least_effective(fit));
  }
  save_and_advise(options, fit, request);
}

void fit_to_log(const FitResponderOptions& options, std::uint64_t seed) {
  const LogIntegrity integrity = integrity_of({options.db}, {}, options.unverified);
  const LoggedPeople logged = logged_people(LogReader(options.db), options.db);
  const Bank::Request request{config_of(options, repeated_stimuli(logged, options.repeats), seed),
                              options.free,
                              {},
                              options.people,
                              options.jobs,
                              logged.people};
  const ResponderFit fit = fit_responder_to_answers(bank_of(request));
  if (options.json) {
    fmt::print("{}", as_json(fit, options.people, seed));
  } else {
    print("{} by {} of {} ({})\n\n", counted(logged.n_trials, "answer"),
          counted(static_cast<int>(logged.people.size()), "participant"), options.db,
          integrity.words);
    print_parameters(fit);
    print("\nlog likelihood: {:.2f}, {:.3f} per answer\n", fit.fitted,
          fit.fitted / logged.n_trials);
    print_cautions(fit, options.people, enough_for_answers);
  }
  save_and_advise(options, fit, request);
}

void fit_the_responder(const FitResponderOptions& options) {
  const std::uint64_t seed = options.seed ? *options.seed : 1;
  if (options.free.empty())
    throw Error("--free: expected at least one free parameter", ExitCode::usage);
  if (options.db.empty() == options.figures.empty())
    throw Error("expected PROTOCOL with --figures FILE, or --db LOG", ExitCode::usage);
  if (options.db.empty() == options.protocol.empty())
    throw Error(options.db.empty() ? "--figures: expected PROTOCOL, too"
                                   : "--db: the log has its protocol; expected no PROTOCOL",
                ExitCode::usage);
  if (!options.db.empty() && !options.set.empty())
    throw Error("--set: the log has its protocol's settings; expected none", ExitCode::usage);
  options.db.empty() ? fit_to_figures(options, seed) : fit_to_log(options, seed);
}

}  // namespace

void add_fit_responder(Command& app) {
  const auto options = std::make_shared<FitResponderOptions>();
  Command command = app.add_command(
      "fit-responder", "which simulated people give a study's figures or a log's answers",
      {"heft fit-responder protocols/paper.toml --figures protocols/examples/paper_figures.toml "
       "--free criterion_mm=1..40",
       "heft fit-responder protocols/paper.toml --figures mine.toml --free criterion_mm=1..40 "
       "--free criterion_mm.spread=0.1..1 --save fitted.toml",
       "heft fit-responder --db heft.db --free criterion_mm=1..40"});
  command.add_option("PROTOCOL", &options->protocol, "a protocol file; with --figures");
  command.add_option("--figures", &options->figures,
                     "FILE.toml: means and SDs over participants that a study reported");
  command.add_option("--db", &options->db,
                     "a log: the answers of its sorting and comparison trials");
  add_responder(command, options->model,
                "NAME:FILE, the model and its fixed parameters (default: simulated)");
  command.add_option("--free",
                     ReadsText{[options](const std::string& text) {
                                 options->free.push_back(read_free_parameter(text));
                               },
                               true},
                     "NAME=LOW..HIGH ...: a free median, or NAME.spread, within bounds (up to 7)");
  command.add_option("--people", &options->people, "simulated participants, spread over the bounds")
      .shows_default()
      .whole_number(100, 1'000'000);
  command
      .add_option("--repeats", &options->repeats,
                  "with --db: answers of each simulated participant to each stimulus")
      .shows_default()
      .whole_number(10, 10'000);
  add_unverified(command, options->unverified);
  command.add_jobs(options->jobs, "the result does");
  command.add_seed(options->seed, "1");
  command.add_option("--save", &options->save, "FILE.toml: the fitted model");
  command.add_flag("--json", options->json, "all figures as JSON on stdout");
  add_settings(command, options->set,
               "change a key of the protocol, such as coupling.stiffness_n_per_m=100");
  command.does([options] { fit_the_responder(*options); });
}

}  // namespace heft::cli
