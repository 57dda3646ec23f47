// Which procedure estimates a threshold well in few trials, for which people: each procedure with
// 24 simulated observers, three-way and forced choice, at a reference of 200 g.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "inference/Fit.h"
#include "psychophysics/Procedure.h"
#include "results/Study.h"

namespace heft {

/// The answers that a trial offers: comparison, reference or no difference; or only the first two.
enum class AnswerSet { three_way, forced_choice };
template <>
struct EnumNames<AnswerSet> {
  static constexpr std::array<std::string_view, 2> names{"three_way", "forced_choice"};
};

/// A simulated person of the indecision model, whose parameters may change during the session.
struct Observer {
  enum class Kind { person, coin, always_heavier, never_different };

  std::string_view name;
  double threshold_g = 140;    ///< 75 % correct in forced choices without bias, in the first trial
  double criterion_sd = 1.64;  ///< half-width; equal cubes are called different in 10 % of trials
  double bias_sd = 0;          ///< to the comparison
  double lapse = 0.02;
  /// The values in trial 100, which are reached evenly (threshold: in equal ratios).
  std::optional<double> later_threshold_g{}, later_criterion_sd{}, later_lapse{};
  Kind kind = Kind::person;

  /// @param trial from 0
  double threshold_in(int trial) const;
  double criterion_in(int trial) const;
  /// @param level_g comparison minus reference
  Choice answer(double level_g, int trial, AnswerSet answers, RandomStream& stream) const;
};

std::span<const Observer> study_observers();

/// A procedure of one answer set. When it ends before the session does, it starts again.
struct StudiedProcedure {
  std::string_view name;
  AnswerSet answers;
  Procedure procedure;
  bool counts_correct = false;  ///< its positive answer is "comparison", otherwise any difference
  /// What it says itself: the mean of its estimates, or its posterior; none: it needs a fit.
  enum class Own { none, reversals, posterior } own = Own::none;
};

std::vector<StudiedProcedure> studied_procedures();

/// What is known after some trials.
struct Reading {
  std::optional<double> threshold_g{}, low_g{}, high_g{}, criterion_sd{};
};

enum class Estimator { own, fit };
template <>
struct EnumNames<Estimator> {
  static constexpr std::array<std::string_view, 2> names{"own", "fit"};
};

/// One row of observers.csv: a procedure, its estimator and an observer after some trials.
struct ObserverFigures {
  std::string_view procedure, observer;
  AnswerSet answers{};
  StudiedProcedure::Own own{};  ///< what the procedure says itself
  Estimator estimator{};
  int n_trials = 0, n_runs = 0, n_printed = 0;  ///< printed: runs that gave a threshold
  /// Of the natural logarithm of the threshold, against its mean over the trials.
  double rmse = 0, bias = 0;
  double coverage = 0;  ///< share of 95 % intervals that hold it; NaN: there are none
  double criterion_rmse = 0, criterion_bias = 0;  ///< in SD of the noise; NaN: none
};

/// The numbers of trials at which procedures are read.
inline constexpr std::array trials_read{20, 40, 60, 100};

std::vector<ObserverFigures> run_observers(const StudyOptions& options);

/// Tiles of bias by procedure and observer.
std::string failures_chart(const std::vector<ObserverFigures>& figures,
                           const StudyOptions& options);
/// Error against trials, median and worst observer.
std::string errors_chart(const std::vector<ObserverFigures>& figures, const StudyOptions& options);

void run_procedures_study(const StudyOptions& options);

}  // namespace heft
