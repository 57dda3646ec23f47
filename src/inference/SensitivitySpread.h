// Sensitivities on a grid, on which each person's likelihood is known, and how the sensitivities of
// people who see something are spread, together with their criteria: see PooledSensitivity.h.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "inference/CriteriaFit.h"

namespace heft {

/// Sensitivities per largest level: dense around 0, and up to thresholds of a four-hundredth of it.
inline constexpr std::size_t n_grid = 56;
inline constexpr std::size_t no_sensitivity = 20;  ///< the place of 0
inline double sensitivity_at(double place) {
  constexpr double place_step = 0.2;
  return 0.5 * std::sinh(place_step * (place - static_cast<double>(no_sensitivity)));
}

/// A value, usually a log likelihood, at each grid point.
using OnGrid = std::array<double, n_grid>;

/// Sum over people, each weighted by `times`.
OnGrid sum_of(std::span<const OnGrid> people, std::span<const double> times);

/// The place where a sum is highest, by the parabola through the three highest.
double top_of(const OnGrid& sum);

/// A value between grid points, interpolated. @param place index on the grid, from 0
double between_places(const OnGrid& values, double place);

/// How sensitivities are spread between people: their logarithm is normal.
struct Spectrum {
  double mean_log = 0, sd_log = 0.3;
};

/// The likelihood of each person's sensitivities above none, as a density over their logarithm.
class PositiveSensitivities {
 public:
  /// @param people log likelihoods; of places that aren't above none any
  explicit PositiveSensitivities(std::span<const OnGrid> people);

  /// By person: log likelihoods of medians on the grid, where people are spread so much. What is
  /// not above none can't be.
  std::vector<OnGrid> of_medians(double sd_log) const;
  /// By the EM algorithm.
  Spectrum fit(Spectrum from, int n_steps) const;
  /// By person: how likely each place above none is, the first being the one after it. Sums to 1.
  std::vector<std::vector<double>> posteriors(const Spectrum& spectrum) const;

 private:
  static constexpr std::size_t n_places = n_grid - no_sensitivity - 1;
  using OnPlaces = std::array<double, n_places>;

  double width(std::size_t i) const;
  OnPlaces density_of(const Spectrum& spectrum) const;

  OnPlaces logs_{};
  std::vector<OnPlaces> densities_;
};

/// People's log likelihoods by sensitivity where both sensitivities and criteria differ between
/// them, each on their own: with one that all have in common, the criteria would have to make up
/// for the differences, and the median came out 5 % too large at an indecision of 2 SD.
struct SpreadSensitivities {
  std::vector<OnGrid> log_likelihood;  ///< only above none
  Spectrum spectrum;
};

/// By the EM algorithm.
/// @param people their criteria are where to begin
/// @param place where they are together most likely
SpreadSensitivities spread_sensitivities(std::vector<PersonAnswers> people, double place);

}  // namespace heft
