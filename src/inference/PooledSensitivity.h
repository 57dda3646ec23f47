// Sensitivity to a mass difference from the three-way choices of several people, whatever
// their criteria.
//
// Each person follows the indecision model (psychophysics/ObserverModels.h) with a lapse rate
// of .02 and an own indecision and side bias, which are random effects: log indecision
// and bias are normal over people, with spreads estimated from the answers (EM), and integrated out
// (Laplace). To maximize them out instead makes the sensitivity of 20 to 50 trials a person 8 to 50
// % too large. What remains is each person's likelihood of a sensitivity, on a grid.
//
// The sensitivity that all have in common says whether there is any: its interval holds 0 or not.
// Where there is, the estimate is the median of sensitivities that are log-normal over people, each
// with its own criteria (SensitivitySpread.h). Intervals come from a bootstrap over people: as
// many as the study has are drawn with replacement, and the percentiles are taken farther out, as
// Student's t and n/(n-1) ask for where people are few (Hesterberg 2015, "expanded percentile
// interval"); the median's are symmetric about its logarithm (Hall 1988). The indecision's comes
// from the same samples, each at its own sensitivity, with people as their answers have them: as
// random effects, drawn towards each other, they differ too little, and the interval held the truth
// in 65 to 90 %.
//
// Levels are signed by side: mass on the right minus mass on the left, and the answers are left,
// none, right. A person can prefer a side but not the reference, which nothing marks; and as sides
// are redrawn, what earlier answers did to a staircase's level can't pass for sensitivity.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "inference/Fit.h"
#include "inference/Statistics.h"

namespace heft {

inline constexpr double fixed_lapse = 0.02;

/// With fewer people (but one alone, of whom the interval is their own) there is no interval.
inline constexpr int least_people = 5;

/// One person's own, per gram, with criteria that are random effects too: by maximum likelihood of
/// all three (heft fit) the interval of 20 to 50 trials lies too high, and holds the truth in 82 to
/// 94 %. Ends where the likelihood has fallen as for a 95 % profile interval, with Student's t for
/// as many trials; none: it never does.
struct OwnSensitivity {
  double value = 0;
  std::optional<double> low{}, high{};
};

struct PooledSensitivity {
  int n = 0;  ///< people with a trial
  double n_trials = 0;
  std::string why;                    ///< there is no threshold; empty: there is
  std::optional<double> sensitivity;  ///< per gram; of the median person
  std::optional<Interval> sensitivity_interval;
  std::optional<double> sd_log_sensitivity;  ///< between people
  std::optional<double> threshold_75_g;      ///< 75 % correct in a forced choice without bias
  std::optional<Interval> threshold_interval_g;
  /// Of the median person: half the width between the criteria, in SDs of what is felt. Also where
  /// there is no threshold; none where the likelihood is flat in the sensitivity.
  std::optional<double> indecision;
  std::optional<Interval> indecision_interval;
  /// By participant, of those with a trial; empty: too few to draw on.
  std::map<std::string, OwnSensitivity> people{};
  /// By bootstrap sample; the same people are in it at all references of one study, so that these
  /// can be compared.
  std::vector<double> sensitivity_samples;

  bool identifiable() const { return why.empty(); }
};

/// Percentiles of bootstrap samples, farther out where people are few. n_people > 1.
Interval expanded_percentiles(const std::vector<double>& samples, std::size_t n_people,
                              double confidence = confidence_level);

/// Of a figure above 0, symmetric about the estimate on the scale of logarithms (Hall 1988): what
/// that share of bootstrap samples reaches to either side, more where people are few. n_people > 1.
Interval symmetric_interval(double estimate, const std::vector<double>& samples,
                            std::size_t n_people, double confidence);

/// Identifiable: the interval of the sensitivity lies above 0 and that of the threshold ends at
/// most at twice the largest level.
/// @param people  answers (left, none, right) by signed level in g, by participant
/// @param study  the participants of all references
PooledSensitivity pooled_sensitivity(std::map<std::string, AnswersByLevel> people,
                                     const std::set<std::string>& study);

/// One person's at one reference.
struct OwnThreshold {
  std::optional<double> threshold_75_g;  ///< none: not identifiable
  std::optional<Interval> interval_g;    ///< see OwnSensitivity; of fewer people profile likelihood
  std::string why;                       ///< not identifiable; empty: it is
};

/// @param answers  left, none, right by signed level in g
/// @param own  of the same answers among several people's; null: too few people to draw on
OwnThreshold own_threshold(const AnswersByLevel& answers, const OwnSensitivity* own);

/// The interval of the second threshold divided by the first, both identifiable and of one study:
/// each bootstrap sample draws the same people at both.
Interval threshold_ratio_interval(const PooledSensitivity& first, const PooledSensitivity& second,
                                  double confidence = confidence_level);

}  // namespace heft
