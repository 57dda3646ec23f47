// Whether a fitted curve describes the answers at all: the deviance from the saturated model, which
// has one free share for each level, against the deviances of simulated answers. These have the
// fitted curve's probabilities at the same levels, equally often, and are fitted again (parametric
// bootstrap: Wichmann & Hill 2001). The chi-square distribution is no substitute with few trials.
//
// This holds where levels were chosen beforehand (constant stimuli). Where an adaptive procedure
// chose them by earlier answers, other answers would have led to other levels.
#pragma once

#include <optional>
#include <string>

#include "inference/Fit.h"

namespace heft {

/// Minimum number of trials at each level for a check.
inline constexpr double least_trials_at_level = 5;
/// Maximum ratio of the numbers of trials at two levels: constant stimuli are shown about equally
/// often, an adaptive procedure shows most where it ends.
inline constexpr double most_unequal_levels = 4;

struct GoodnessOfFit {
  std::optional<double> deviance{};  ///< none: `why` has the reason
  int degrees_of_freedom = 0;        ///< free shares of the saturated model less free parameters
  /// The share of data sets whose deviance is at least as large, of the simulated and the real one.
  std::optional<double> p{};
  int n_simulated = 0;
  std::string why{};  ///< reason that the fit cannot be judged

  bool fits() const { return !p || *p >= 0.05; }
};

/// @param fit of these answers with these options
GoodnessOfFit check_psychometric(const AnswersByLevel& answers, const FitOptions& options,
                                 const Fit& fit);
GoodnessOfFit check_indecision(const AnswersByLevel& answers, const FitOptions& options,
                               const Fit& fit);
/// Goodness of fit_forced_choice().
GoodnessOfFit check_forced_choice(const AnswersByLevel& answers);
/// Goodness of fit_same_different() with fixed_lapse. Levels of either sign are merged, as in that
/// fit.
GoodnessOfFit check_same_different(const AnswersByLevel& answers);

// Log likelihoods of refits to simulated answers at a fit's levels: a search from the first fit,
// without intervals and reasons.

/// Log likelihood of fit_psychometric(); in PsychometricFit.cpp. @param near identifiable, with
/// these options
double refitted_psychometric(const AnswersByLevel& answers, const FitOptions& options,
                             const Fit& near);

/// Log likelihood of fit_indecision(); in IndecisionFit.cpp. @param near identifiable, with these
/// options
double refitted_indecision(const AnswersByLevel& answers, const FitOptions& options,
                           const Fit& near);

/// Log likelihood of fit_same_different(); in IndecisionFit.cpp. @param near identifiable
double refitted_same_different(const AnswersByLevel& answers, const Fit& near);

/// What fit_forced_choice fits with.
FitOptions forced_choice_options(const AnswersByLevel& answers);

}  // namespace heft
