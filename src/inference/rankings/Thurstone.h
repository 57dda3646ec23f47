// Perceived values of stimuli from rank orders: Thurstone's law of comparative judgment (1927),
// case V. Each stimulus of a trial is perceived as its value plus independent noise of one SD, and
// ranked as perceived. The unit is the SD of a difference of two percepts, so that a stimulus at a
// distance d is ranked above the other in a share Phi(d) of trials.
//
// Maximum likelihood of whole orders (Daniels 1950): the pairs of one order are not
// independent, and are not counted as if they were. The trials of one person are not independent
// either: intervals end where the profile likelihood has fallen by t^2/2 (n - 1 degrees of freedom
// for n people) times the ratio of the variance over people to the variance of independent trials
// (vertical scaling: Chandler & Bate 2007). The former is the jackknife's, to first order. The
// ratio is limited to at least the value that 97.5 % of studies with independent trials exceed.
//
// Values are those of all people together. Where people differ in sensitivity, they are closer
// together than those of the median person.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "inference/Statistics.h"

namespace heft {

/// Stimuli (masses in g) in the order given to them, lowest first.
using RankOrder = std::vector<double>;
/// How often each person gave which order.
using OrdersByPerson = std::map<std::string, std::map<RankOrder, int>>;

/// Difference of the perceived values of two stimuli.
struct PerceivedDistance {
  std::optional<double> value{};  ///< none: not identifiable
  std::optional<Interval> interval{};
  int n = 0;          ///< people who ranked both, not always in one trial
  std::string why{};  ///< reason that there is no value
  /// Change of the value without each person, to first order; empty for a single person.
  std::map<std::string, double> influence{};
};

struct PerceivedStimulus {
  double stimulus = 0;
  PerceivedDistance from_lowest{};  ///< of the lowest itself: 0 if any other has one
  PerceivedDistance from_previous{};
};

/// Identifiable: orders of at least least_people, or of a single person, whose interval is then
/// over trials; and neither of the two stimuli was always above the other, directly or by way of
/// others (Ford 1957).
/// @return by stimulus, ascending
std::vector<PerceivedStimulus> perceived_values(const OrdersByPerson& people);

/// `to` less `from`, distances of several people in two conditions. The standard errors are those
/// of their intervals (half-width by Student's t); people who ranked in both correlate them as
/// their influences do.
Contrast perceived_contrast(const PerceivedDistance& from, const PerceivedDistance& to);

/// log P(X_1 < ... < X_n) and its derivatives by the values.
struct RankingProbability {
  double log_p = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

/// X_k ~ N(values[k], 1/2), so that the difference of two has an SD of 1. Relative error of p below
/// 1e-6 where p is above 1e-5; log_p is concave in the values, and depends on their differences
/// only.
/// @param values of at least two items, in the order in which they were ranked
RankingProbability ranking_probability(const Eigen::VectorXd& values);

}  // namespace heft
