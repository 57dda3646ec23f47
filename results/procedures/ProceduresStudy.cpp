#include "results/procedures/ProceduresStudy.h"

#include <cmath>

#include "base/Parallel.h"
#include "inference/Statistics.h"

namespace heft {

namespace {
/// One person's session by one procedure, up to any of its trials.
class Session {
 public:
  Session(const StudiedProcedure& studied, const Observer& observer, std::uint64_t seed)
      : studied_(studied),
        observer_(observer),
        stream_(seed, "observer"),
        procedure_(studied.procedure),
        levels_(seed, "levels of run 0"),
        seed_(seed) {}

  void go_on_to(int n_trials) {
    for (; trial_ < n_trials; ++trial_) {
      const double level_g = procedure_.next_level(levels_);
      const Choice choice = observer_.answer(level_g, trial_, studied_.answers, stream_);
      answers_[level_g][place_of(choice)] += 1;
      Response response = response_of(choice);
      if (studied_.counts_correct) response.positive = choice == Choice::comparison;
      procedure_.respond(response, level_g);
      if (procedure_.finished()) start_again();
    }
  }

  Reading read(Estimator estimator) const {
    if (estimator == Estimator::fit)
      return studied_.answers == AnswerSet::forced_choice ? by_forced_fit() : by_three_way_fit();
    return studied_.own == StudiedProcedure::Own::posterior ? by_posterior() : by_reversals();
  }

 private:
  std::size_t place_of(Choice choice) const {
    if (studied_.answers == AnswerSet::forced_choice) return choice == Choice::comparison ? 1 : 0;
    return choice == Choice::reference ? 0 : choice == Choice::none ? 1 : 2;
  }

  void start_again() {
    finished_.push_back(procedure_.estimates().front().value.value_or(0));
    procedure_ = studied_.procedure;
    levels_ = RandomStream(seed_, fmt::format("levels of run {}", finished_.size()));
  }

  // Of a procedure that has not ended, what it has so far.
  Reading by_reversals() const {
    const double value =
        finished_.empty() ? procedure_.estimates().front().value.value_or(0) : *mean(finished_);
    Reading reading;
    if (value > 0) reading.threshold_g = value;
    return reading;
  }

  Reading by_posterior() const {
    const Estimate estimate = procedure_.estimates().front();
    Reading reading{estimate.value, estimate.low, estimate.high, std::nullopt};
    for (const ParameterPosterior& parameter : procedure_.posterior())
      if (parameter.name == "indecision" && parameter.sd > 0) reading.criterion_sd = parameter.mean;
    return reading;
  }

  Reading by_three_way_fit() const {
    const Fit fit = fit_indecision(answers_, {.guess = 0, .lapse = fixed_lapse});
    if (!fit.identifiable()) return {};
    const FittedParameter& threshold = fit.parameter("threshold_75_g");
    return {threshold.value, threshold.low, threshold.high, fit.parameter("indecision").value};
  }

  Reading by_forced_fit() const {
    const FittedParameter threshold = fit_forced_choice(answers_).threshold;
    return {threshold.value, threshold.low, threshold.high, std::nullopt};
  }

  const StudiedProcedure& studied_;
  const Observer& observer_;
  RandomStream stream_;
  Procedure procedure_;
  RandomStream levels_;
  std::uint64_t seed_;
  AnswersByLevel answers_;
  std::vector<double> finished_;  ///< estimates; 0: none
  int trial_ = 0;
};

struct Truth {
  double log_threshold = 0, criterion_sd = 0;  // means over the trials
};

Truth truth_of(const Observer& observer, int n_trials) {
  Truth truth;
  for (int trial = 0; trial < n_trials; ++trial) {
    truth.log_threshold += std::log(observer.threshold_in(trial)) / n_trials;
    truth.criterion_sd += observer.criterion_in(trial) / n_trials;
  }
  return truth;
}

double rms(const std::vector<double>& errors) {
  double squares = 0;
  for (const double error : errors) squares += error * error;
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

void put_figures(ObserverFigures& figures, const std::vector<Reading>& readings, const Truth& truth,
                 bool is_person) {
  std::vector<double> errors, criterion_errors;
  double n_intervals = 0, n_held = 0;
  for (const Reading& reading : readings) {
    if (!(reading.threshold_g > 0)) continue;  // QUEST's grid has thresholds below 0
    ++figures.n_printed;
    errors.push_back(std::log(*reading.threshold_g) - truth.log_threshold);
    if (reading.criterion_sd)
      criterion_errors.push_back(*reading.criterion_sd - truth.criterion_sd);
    if (!reading.low_g && !reading.high_g) continue;
    ++n_intervals;
    const double threshold_g = std::exp(truth.log_threshold);
    n_held += reading.low_g.value_or(0) <= threshold_g &&
              threshold_g <= reading.high_g.value_or(INFINITY);
  }
  figures.n_runs = static_cast<int>(readings.size());
  figures.rmse = figures.bias = figures.coverage = NAN;
  figures.criterion_rmse = figures.criterion_bias = NAN;
  if (!is_person || errors.empty()) return;
  figures.rmse = rms(errors);
  figures.bias = *mean(errors);
  if (n_intervals > 0) figures.coverage = n_held / n_intervals;
  if (criterion_errors.empty()) return;
  figures.criterion_rmse = rms(criterion_errors);
  figures.criterion_bias = *mean(criterion_errors);
}

std::vector<ObserverFigures> figures_of(const StudiedProcedure& studied, const Observer& observer,
                                        int n_runs, std::uint64_t seed) {
  const auto n_read = trials_read.size();
  std::array<std::vector<std::vector<Reading>>, 2> readings;
  for (auto& of_estimator : readings) of_estimator.resize(n_read);
  for (int run = 0; run < n_runs; ++run) {
    Session session(studied, observer, seed + static_cast<std::uint64_t>(run));
    for (std::size_t i = 0; i < n_read; ++i) {
      session.go_on_to(trials_read[i]);
      for (const Estimator estimator : {Estimator::own, Estimator::fit})
        if (estimator == Estimator::fit || studied.own != StudiedProcedure::Own::none)
          readings[static_cast<std::size_t>(estimator)][i].push_back(session.read(estimator));
    }
  }
  std::vector<ObserverFigures> all;
  for (const Estimator estimator : {Estimator::own, Estimator::fit})
    for (std::size_t i = 0; i < n_read; ++i) {
      const auto& of_estimator = readings[static_cast<std::size_t>(estimator)][i];
      if (of_estimator.empty()) continue;
      ObserverFigures figures{studied.name, observer.name, studied.answers,
                              studied.own,  estimator,     trials_read[i]};
      put_figures(figures, of_estimator, truth_of(observer, trials_read[i]),
                  observer.kind == Observer::Kind::person);
      all.push_back(figures);
    }
  return all;
}
}  // namespace

// Every procedure meets people with the same random numbers.
std::vector<ObserverFigures> run_observers(const StudyOptions& options) {
  const std::vector<StudiedProcedure> procedures = studied_procedures();
  std::span<const Observer> observers = study_observers();
  if (options.quick) observers = observers.last(6);
  const int n_runs = options.quick ? 2 : 200;
  std::vector<ObserverFigures> all;
  StudyProgress progress(static_cast<int>(procedures.size()));
  for (const StudiedProcedure& studied : procedures) {
    progress.next(studied.name);
    std::vector<std::vector<ObserverFigures>> of_observer(observers.size());
    in_parallel(observers.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        of_observer[i] = figures_of(studied, observers[i], n_runs, options.seed + 1'000'000 * i);
    });
    for (const auto& figures : of_observer) all.insert(all.end(), figures.begin(), figures.end());
  }
  return all;
}

void run_procedures_study(const StudyOptions& options) {
  CsvFile csv(options, "observers.csv",
              "answers,procedure,estimator,observer,trials,runs,printed,log_rmse,log_bias,coverage,"
              "criterion_rmse_sd,criterion_bias_sd");
  const std::vector<ObserverFigures> figures = run_observers(options);
  for (const ObserverFigures& row : figures)
    csv.row(name_of(row.answers), row.procedure, name_of(row.estimator), row.observer, row.n_trials,
            row.n_runs, row.n_printed, row.rmse, row.bias, row.coverage, row.criterion_rmse,
            row.criterion_bias);
  draw(options, "failures", failures_chart(figures, options));
  draw(options, "errors", errors_chart(figures, options));
}

}  // namespace heft
