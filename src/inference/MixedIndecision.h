// Thresholds of several people from their three-way choices: the mixed indecision model.
//
// Person i perceives D = s_i x + b_i + N(0, 1) on a signed difference x, and answers "comparison"
// if D > tau_i, "reference" if D < -tau_i, otherwise "none" (psychophysics/ObserverModels.h). log s
// and log tau are jointly normal over people, b is normal around 0, and all share a lapse rate that
// is free in [0, .2]. The person's effects are integrated out (PersonIntegral.h); estimates are
// maximum likelihood, intervals profile likelihood with a cut for few people
// (PopulationLikelihood.h).
//
// The likelihood holds under adaptive placement, because the levels of a person depend only on the
// same person's earlier answers. Answers of several people in one curve do not: staircases send
// insensitive people to large levels.
//
// With sides (left, none, right by the mass on the right minus that on the left) what earlier
// answers did to a staircase's level cannot pass for sensitivity, and b is a preference for a side.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "inference/Fit.h"
#include "inference/Statistics.h"

namespace heft {

/// Answers by signed level in g, by participant: reference, none, comparison; or left, none, right.
using AnswersByPerson = std::map<std::string, AnswersByLevel>;

/// A positive figure of a fit. low none: 0; high none: infinite.
struct MixedFigure {
  double value = 0;
  std::optional<double> low{}, high{};
};

/// One person's sensitivity per g; it may be negative. Criterion and side bias are integrated over
/// their distribution, and the lapse rate is that of all. The ends are where the likelihood has
/// fallen as for a 95 % profile interval, with Student's t for the number of trials; none: the
/// interval is unbounded.
struct OwnSensitivity {
  double value = 0;
  std::optional<double> low{}, high{};
};

struct ThresholdAtLapse {
  double lapse = 0, threshold_75_g = 0;
};

struct MixedFit {
  int n = 0;  ///< people with a trial
  double n_trials = 0;
  std::string why;  ///< reason that there is no threshold; empty: there is one
  double log_likelihood = 0;
  std::optional<MixedFigure> sensitivity;  ///< per g, of the median person
  std::optional<MixedFigure> threshold_75_g;
  /// Criterion half-width of the median person, in SDs of internal noise. Also where there is no
  /// threshold, but none where the likelihood is flat in the sensitivity.
  std::optional<MixedFigure> indecision;
  std::optional<MixedFigure> lapse;  ///< high is none: rates up to .2 are likely
  std::optional<double> sd_log_sensitivity, sd_log_indecision, correlation, sd_bias;
  /// Thresholds for rates of 0, .02 and .05 if the lapse rate is not identifiable; otherwise empty.
  std::vector<ThresholdAtLapse> at_lapse;
  /// By participant; empty for fewer than least_people.
  std::map<std::string, OwnSensitivity> people;
  /// By participant: how log(threshold_75_g) would change if the person counted twice, to first
  /// order and scaled to the width of the threshold's interval. Empty where there is no threshold.
  std::map<std::string, double> influence;

  bool identifiable() const { return why.empty(); }
  /// Null: fewer than least_people.
  const OwnSensitivity* own(const std::string& participant) const;
  /// sensitivity, indecision, lapse, sd_log_sensitivity, sd_log_indecision, correlation, sd_bias
  /// and threshold_75_g, without standard errors.
  Fit summary() const;
};

/// Identifiable if the interval of the sensitivity is above 0 and bounded, and that of the
/// threshold ends at most at twice the largest level.
MixedFit fit_mixed_indecision(AnswersByPerson people);

/// One person's threshold at one reference.
struct OwnThreshold {
  std::optional<double> threshold_75_g;  ///< none: not identifiable
  std::optional<Interval> interval_g;
  std::string why;  ///< reason that it is not identifiable; empty: it is
};

/// @param own the person's sensitivity in the mixed fit; null: too few people, then these answers
///   are fitted alone with fixed_lapse
OwnThreshold own_threshold(const AnswersByLevel& answers, const OwnSensitivity* own);

/// A weighted sum of the log thresholds of several fits, over the people in any of them. The
/// variance is the infinitesimal jackknife's (Jaeckel 1972), so that what the same people have in
/// common in several fits cancels.
/// @param fits identifiable, with n >= least_people together
Contrast threshold_contrast(std::span<const MixedFit* const> fits, std::span<const double> weights);

/// The least-squares slope of log threshold on log reference: the exponent beta of threshold ~
/// reference^beta; 0: thresholds are equal, 1: proportional (Weber's law). At least two references,
/// all above 0.
Contrast threshold_exponent(std::span<const MixedFit* const> fits,
                            std::span<const double> references_g);

}  // namespace heft
