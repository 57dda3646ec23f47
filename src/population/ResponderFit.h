// Fits populations of simulated participants to the figures that a study reports, or to the answers
// of a log.
//
// Simulating every population that a search visits would take days. Instead, a bank of participants
// is simulated once: their free parameters are spread evenly over the bounds (logarithms), the
// others are drawn as the model's file says. A population, log-normal in the free parameters, is
// the bank with weights: density of the population over density of the bank (importance sampling).
// Its figures are weighted means and standard deviations, smooth in the population's parameters.
//
// Likelihood of figures: a reported mean of n participants is normal about the population's mean
// with variance sd^2 / n, the logarithm of a reported standard deviation normal with variance
// (kurtosis - 1) / 4n. Correlations between figures are not modeled. The bank's sampling error is
// added to both.
//
// Likelihood of a log's answers: each participant of the bank answers the same stimuli many times,
// which gives a logged person's answers a probability. The likelihood of a population is the
// product over people of the weighted mean of that probability.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inference/MaximumLikelihood.h"
#include "population/Figures.h"
#include "population/LoggedAnswers.h"

namespace heft {

/// @param text "LOW..HIGH", each with the unit: "10..1000", "10g..1000g"
/// @return none unless both are numbers above 0, the smaller one first
std::optional<std::pair<double, double>> positive_range_in(std::string_view text,
                                                           std::string_view unit = {});

/// A parameter of the population: the median of a responder's parameter, or its spread.
struct FreeParameter {
  std::string name;          ///< "criterion_mm" or "criterion_mm.spread"
  double low = 0, high = 0;  ///< bounds; low above 0
};

/// @param text "NAME=LOW..HIGH"
/// @throws Error (usage) with what was expected
FreeParameter read_free_parameter(const std::string& text);

/// Simulated participants over the bounds of the free parameters.
class Bank {
 public:
  struct Request {
    ResolvedConfig config;  ///< protocol, model, seed; the tracker is the surrogate
    std::vector<FreeParameter> free;
    std::vector<FigurePlace> places;
    int people = 4000;
    int jobs = 1;
    /// People whose answers are to have a likelihood; the protocol repeats their stimuli.
    std::vector<AnswerCounts> logged = {};
  };

  /// @param progress called with the fraction done, from the calling thread
  /// @return none: stopped
  /// @throws Error (usage) if a free parameter is not the model's, or its bounds exceed the table's
  static std::optional<Bank> simulate(const Request& request,
                                      const std::function<void(double)>& progress,
                                      const std::atomic<bool>& stop);

  /// A figure of a population.
  struct Moments {
    double mean = 0, sd = 0, kurtosis = 3;
    double effective = 0;  ///< number of equally weighted participants with the same error
    bool exists() const { return effective > 0; }  ///< whether anyone has the figure
  };
  /// @param at the free parameters, in the order of the request
  /// @param moments one for each place; the mean is NaN where no participant has the figure
  void moments(const Parameters& at, std::vector<Moments>& moments) const;

  /// The answers of the logged people in a population.
  struct AnswersLikelihood {
    double log_likelihood = 0;
    double effective = 0;  ///< smallest number of participants that one person's answers fit
  };
  AnswersLikelihood of_answers(const Parameters& at) const;

  const std::vector<FreeParameter>& free() const { return free_; }
  const std::vector<FigurePlace>& places() const { return places_; }
  /// Whether any participant has the figure of that place.
  bool has(std::size_t place) const {
    return !figures_.col(static_cast<Eigen::Index>(place)).array().isNaN().all();
  }
  int people() const { return static_cast<int>(logs_.rows()); }

 private:
  struct Drawn {
    std::string name;              ///< of a responder's parameter with a free median or spread
    double low = 0, high = 0;      ///< of the bank, logarithms
    int median = -1, spread = -1;  ///< index among the free parameters; -1: fixed
    double fixed_median = 0, fixed_spread = 0;
  };
  void plan(const Request& request);
  Eigen::ArrayXd weights(const Parameters& at) const;  // the largest is 1

  std::vector<FreeParameter> free_;
  std::vector<FigurePlace> places_;
  std::vector<Drawn> drawn_;
  Eigen::MatrixXd logs_;     ///< participant x drawn
  Eigen::MatrixXd figures_;  ///< participant x place; NaN: none
  Eigen::MatrixXd answers_;  ///< participant x logged person: log likelihoods
};

/// One fitted parameter with its 95 % profile interval within the bounds.
struct FreeEstimate {
  FreeParameter free;
  double value = 0;
  std::optional<double> low, high;  ///< none: the interval reaches the bound on that side
  bool identified() const { return low && high; }
};

/// A reported figure and that of the fitted population.
struct ComparedFigure {
  ReportedFigure reported;
  Bank::Moments found;
  /// Distance in standard errors; none: not reported, or no simulated participant has the figure.
  std::optional<double> z_mean, z_sd;
  double log_likelihood = 0;  ///< of the reported mean and SD; 0 if neither was reported
};

struct ResponderFit {
  std::vector<FreeEstimate> parameters;
  std::vector<ComparedFigure> figures;  ///< none: fitted to answers
  double fitted = 0, held_out = 0;      ///< log likelihoods of the fitted and the other figures
  int n_fitted = 0, n_held_out = 0;     ///< numbers of means and standard deviations
  /// Smallest effective number of participants behind a fitted figure, or one person's answers.
  double effective = 0;
  /// Pairs of free parameters whose estimates correlate with |r| above .8.
  struct Pair {
    std::string first, second;
    double correlation = 0;
  };
  std::vector<Pair> alike;
};

/// @param figures places must be those of the bank, in its order
/// @param with_intervals false: estimates only, which take seconds instead of minutes for several
///   free parameters and thousands of people
/// @throws Error (usage) naming a fitted figure that no participant of the bank has
ResponderFit fit_responder(const Bank& bank, std::span<const ReportedFigure> figures,
                           bool with_intervals = true);

/// The population that the logged people of the bank come from.
ResponderFit fit_responder_to_answers(const Bank& bank);

}  // namespace heft
