// Fits each rival to one experiment, simulates studies of 13 people like the paper's, and compares.
#include "results/paper/PaperStudy.h"

#include <algorithm>
#include <atomic>

#include "base/Parallel.h"
#include "base/Program.h"
#include "base/Random.h"
#include "base/files/TextFile.h"
#include "inference/Statistics.h"
#include "responders/ResponderParameters.h"
#include "tasks/Comparison.h"

namespace heft {

namespace {
constexpr int people_per_study = 13;  // the paper's
// Catch trials, which the paper has none of, move no staircase.
constexpr double catch_fraction = 0.1;
constexpr int resting_factor = 2;  // models that touch no cube cost little
constexpr double narrowing = 2.5;  // of the bounds about the first fit, to both sides

struct Sizes {
  int studies = 100;
  std::vector<int> bank{500, 900};  ///< people behind the first fit and the one near it
};

struct Setting {
  const StudyOptions& options;
  Sizes sizes;
  std::vector<ReportedFigure> reported;
  std::vector<PaperFigure> figures;
  std::vector<FigurePlace> places;
  int jobs = 1;
};

Setting setting_of(const StudyOptions& options) {
  Setting setting{options, {}, {}, {}, {}, 1};
  if (options.quick) setting.sizes = {3, {24, 24}};
  const std::string file = installed_file("protocols/examples/paper_figures.toml");
  setting.reported = parse_figures(read_text_file(file), file);
  setting.reported.push_back({{FigureKind::false_alarms, {}, ""}, {}, {}, 1, false});
  setting.figures = paper_figures(setting.reported);
  for (const ReportedFigure& figure : setting.reported) setting.places.push_back(figure.place);
  setting.jobs = n_processors();
  return setting;
}

ResolvedConfig config_of(const Rival& rival, std::uint64_t seed) {
  Protocol protocol = load_protocol(installed_file("protocols/paper.toml"), {});
  for (Block& block : protocol.blocks)
    if (auto* comparison = block_as<Comparison::Block>(block))
      comparison->catch_fraction = catch_fraction;
  SessionOptions given;
  given.responder =
      Plug{rival.responder,
           rival.file.empty() ? "" : installed_file("results/paper/models/" + rival.file)};
  given.tracker = Plug{"surrogate"};
  return resolve(given, protocol, seed);
}

std::vector<FreeParameter> free_in(const Rival& rival, PaperExperiment experiment) {
  std::vector<FreeParameter> free;
  for (const RivalParameter& one : rival.free)
    if (experiment == PaperExperiment::jnd ? one.jnd : one.sorting) free.push_back(one.parameter);
  return free;
}

// One experiment's independent figures.
std::vector<ReportedFigure> fitted_figures(const Setting& setting, PaperExperiment experiment) {
  std::vector<ReportedFigure> fitted;
  for (const PaperFigure& figure : setting.figures)
    if (figure.experiment == experiment && figure.independent && !figure.is_sd) {
      fitted.push_back(setting.reported[figure.place]);
      fitted.back().fitted = true;
    }
  return fitted;
}

std::vector<FreeParameter> narrowed(const std::vector<FreeEstimate>& found) {
  std::vector<FreeParameter> free;
  for (const FreeEstimate& one : found) {
    free.push_back(one.free);
    if (one.free.name.ends_with(spread_ending)) continue;
    free.back().low = std::max(one.free.low, one.value / narrowing);
    free.back().high = std::min(one.free.high, one.value * narrowing);
  }
  return free;
}

ResponderFit fit_rival(const Setting& setting, const ResolvedConfig& config,
                       std::vector<FreeParameter> free, PaperExperiment experiment) {
  const std::vector<ReportedFigure> figures = fitted_figures(setting, experiment);
  std::vector<FigurePlace> places;
  for (const ReportedFigure& figure : figures) places.push_back(figure.place);
  const std::atomic<bool> stop = false;
  ResponderFit fit;
  const int factor = config->model.entry->touches_cubes ? 1 : resting_factor;
  for (const int size : setting.sizes.bank) {
    const int people = factor * size;
    const Bank bank = *Bank::simulate(
        {config, free, places, people, setting.jobs}, [](double) {}, stop);
    fit = fit_responder(bank, figures, false);
    free = narrowed(fit.parameters);
  }
  return fit;
}

std::vector<Parameter> fitted_parameters(const ResolvedConfig& config,
                                         const std::vector<FreeEstimate>& estimates) {
  std::vector<Parameter> parameters = config->model.options.parameters;
  for (const FreeEstimate& one : estimates) {
    const auto is_it = [&](const Parameter& given) {
      return without_median(given.name) == one.free.name;
    };
    std::erase_if(parameters, is_it);
    parameters.push_back({one.free.name, one.value, {}});
  }
  return parameters;
}

// One value for each participant and place.
using PeopleFigures = std::vector<std::vector<std::optional<double>>>;

PeopleFigures simulate_people(const Setting& setting, const ResolvedConfig& config,
                              const std::vector<Parameter>& parameters) {
  const int n = setting.sizes.studies * people_per_study;
  PeopleFigures people(static_cast<std::size_t>(n));
  const auto simulate_one = [&](int i) {
    const std::uint64_t seed =
        RandomStream(setting.options.seed, "paper", static_cast<std::uint64_t>(i)).bits() >> 1;
    const auto responder = config->model.entry->make({seed, parameters, ""});
    people[static_cast<std::size_t>(i)] = figures_of_one(config, *responder, seed, setting.places);
    return true;
  };
  run_jobs(n, setting.jobs, simulate_one, [](double) {});
  return people;
}

// A figure in each study: over the participants who have it.
std::vector<double> in_studies(const PeopleFigures& people, std::size_t place, bool is_sd) {
  std::vector<double> studies;
  for (std::size_t first = 0; first < people.size(); first += people_per_study) {
    std::vector<double> values;
    for (std::size_t i = first; i < first + people_per_study; ++i)
      if (people[i][place]) values.push_back(*people[i][place]);
    if (const auto figure = is_sd ? sample_sd(values) : mean(values)) studies.push_back(*figure);
  }
  return studies;
}

RivalResult result_of(const Setting& setting, const Rival& rival, PaperExperiment fitted_to) {
  RivalResult result;
  result.rival = rival;
  result.fitted_to = fitted_to;
  const ResolvedConfig config = config_of(rival, setting.options.seed);
  const std::vector<FreeParameter> free = free_in(rival, fitted_to);
  if (!free.empty()) {
    const ResponderFit fit = fit_rival(setting, config, free, fitted_to);
    result.parameters = fit.parameters;
    result.effective = fit.effective;
  }
  const PeopleFigures people =
      simulate_people(setting, config, fitted_parameters(config, result.parameters));
  for (const PaperFigure& figure : setting.figures)
    result.figures.push_back(score_of(figure, in_studies(people, figure.place, figure.is_sd)));
  for (std::size_t i = 0; i < setting.places.size(); ++i)
    if (!setting.reported[i].mean)
      result.unreported.push_back(summary_of(in_studies(people, i, false)));
  return result;
}

std::string_view role_of(const RivalResult& result, PaperExperiment experiment) {
  if (result.rival.free.empty()) return "not fitted";
  return experiment == result.fitted_to ? "fitted" : "predicted";
}

void write_figures(const Setting& setting, const std::vector<RivalResult>& results) {
  CsvFile csv(setting.options, "figures.csv",
              "fitted_to_experiment,model,group,experiment,figure,unit,role,paper,mean,low,high,"
              "share_below,hit,log_score,independent,studies");
  for (const RivalResult& result : results)
    for (std::size_t f = 0; f < setting.figures.size(); ++f) {
      const PaperFigure& figure = setting.figures[f];
      const FigureScore& score = result.figures[f];
      csv.row(static_cast<int>(result.fitted_to), result.rival.name, name_of(result.rival.group),
              static_cast<int>(figure.experiment), figure.name,
              unit_of(setting.places[figure.place].kind), role_of(result, figure.experiment),
              figure.value, score.mean, score.low, score.high, score.place, score.hit,
              score.log_score, figure.independent, setting.sizes.studies);
    }
  CsvFile unreported(setting.options, "unreported.csv",
                     "fitted_to_experiment,model,group,figure,unit,mean,low,high,studies");
  for (const RivalResult& result : results) {
    std::size_t u = 0;
    for (std::size_t i = 0; i < setting.places.size(); ++i) {
      if (setting.reported[i].mean) continue;
      const FigureScore& score = result.unreported[u++];
      unreported.row(static_cast<int>(result.fitted_to), result.rival.name,
                     name_of(result.rival.group), text_of(setting.places[i]),
                     unit_of(setting.places[i].kind), score.mean, score.low, score.high,
                     setting.sizes.studies);
    }
  }
}

void write_fits(const Setting& setting, const std::vector<RivalResult>& results) {
  CsvFile csv(setting.options, "parameters.csv",
              "fitted_to_experiment,model,parameter,estimate,from,to,effective_people");
  for (const RivalResult& result : results)
    for (const FreeEstimate& one : result.parameters)
      csv.row(static_cast<int>(result.fitted_to), result.rival.name, one.free.name, one.value,
              one.free.low, one.free.high, result.effective);
  CsvFile totals(setting.options, "totals.csv",
                 "fitted_to_experiment,model,group,experiment,role,hits,figures,log_score");
  for (const RivalResult& result : results)
    for (const auto experiment : {PaperExperiment::sorting, PaperExperiment::jnd}) {
      const RivalResult::Total total = result.total(setting.figures, experiment);
      totals.row(static_cast<int>(result.fitted_to), result.rival.name, name_of(result.rival.group),
                 static_cast<int>(experiment), role_of(result, experiment), total.n_hits, total.n,
                 total.log_score);
      fmt::print("fitted to {}, {:<30} experiment {} {:<10} {:>2} of {}, log score {:6.1f}\n",
                 static_cast<int>(result.fitted_to), result.rival.name,
                 static_cast<int>(experiment), role_of(result, experiment), total.n_hits, total.n,
                 total.log_score);
    }
}
}  // namespace

void run_paper_study(const StudyOptions& options) {
  const Setting setting = setting_of(options);
  const std::vector<Rival> all = rivals();
  StudyProgress progress(2 * static_cast<int>(all.size()));
  std::vector<RivalResult> results;
  for (const auto fitted_to : {PaperExperiment::jnd, PaperExperiment::sorting})
    for (const Rival& rival : all) {
      progress.next(rival.name);
      results.push_back(result_of(setting, rival, fitted_to));
    }
  write_figures(setting, results);
  write_fits(setting, results);
  draw(options, "models", rivals_chart(results, setting.figures, setting.sizes.studies, options));
}

}  // namespace heft
