#include "inference/SensitivitySpread.h"

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
void add(OnGrid& sum, const OnGrid& more, double times) {
  for (std::size_t i = 0; i < n_grid; ++i) sum[i] += times * more[i];
}

constexpr std::size_t first_place = no_sensitivity + 1;

// One person's at every place above none.
using LikelyOnPlaces = std::vector<LikelyCriteria>;

// From a place where the criteria are known outwards, each from where its neighbor found them.
LikelyOnPlaces on_places(const PersonAnswers& person, std::size_t from, const Spread& spread) {
  LikelyOnPlaces all(n_grid - first_place);
  const auto put = [&](PersonAnswers& at, std::size_t place) {
    all[place - first_place] =
        likely_criteria(at, sensitivity_at(static_cast<double>(place)), spread);
  };
  PersonAnswers up = person, down = person;
  for (std::size_t place = from; place < n_grid; ++place) put(up, place);
  for (std::size_t place = from; place-- > first_place;) put(down, place);
  return all;
}

OnGrid log_likelihood_of(const LikelyOnPlaces& places) {
  OnGrid values{};
  for (std::size_t i = 0; i < places.size(); ++i)
    values[first_place + i] = places[i].log_likelihood;
  return values;
}

Spread next_spread(const Spread& last, std::span<const LikelyOnPlaces> people,
                   const std::vector<std::vector<double>>& posteriors) {
  SpreadSums sums;
  for (std::size_t i = 0; i < people.size(); ++i)
    for (std::size_t k = 0; k < people[i].size(); ++k) sums.add(people[i][k], posteriors[i][k]);
  return sums.after(last);
}
}  // namespace

double top_of(const OnGrid& sum) {
  const auto best = static_cast<std::size_t>(std::ranges::max_element(sum) - sum.begin());
  if (best == 0 || best + 1 == n_grid) return static_cast<double>(best);
  const double before = sum[best - 1], here = sum[best], after = sum[best + 1];
  const double bend = before - 2 * here + after;
  return static_cast<double>(best) + (bend < 0 ? (before - after) / (2 * bend) : 0);
}

OnGrid sum_of(std::span<const OnGrid> people, std::span<const double> times) {
  OnGrid sum{};
  for (std::size_t i = 0; i < people.size(); ++i)
    if (times[i] > 0) add(sum, people[i], times[i]);
  return sum;
}

double between_places(const OnGrid& values, double place) {
  const auto before = std::min(static_cast<std::size_t>(place), n_grid - 2);
  return std::lerp(values[before], values[before + 1], place - static_cast<double>(before));
}

PositiveSensitivities::PositiveSensitivities(std::span<const OnGrid> people) {
  for (std::size_t i = 0; i < n_places; ++i)
    logs_[i] = std::log(sensitivity_at(static_cast<double>(first_place + i)));
  for (const OnGrid& person : people) {
    const double best = *std::max_element(person.begin() + first_place, person.end());
    OnPlaces density{};
    for (std::size_t i = 0; i < n_places; ++i)
      density[i] = std::exp(person[first_place + i] - best) * width(i);
    densities_.push_back(density);
  }
}

double PositiveSensitivities::width(std::size_t i) const {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n_places - 1);
  return (logs_[after] - logs_[before]) / static_cast<double>(after - before);
}

PositiveSensitivities::OnPlaces PositiveSensitivities::density_of(const Spectrum& spectrum) const {
  OnPlaces density{};
  for (std::size_t i = 0; i < n_places; ++i) {
    const double z = (logs_[i] - spectrum.mean_log) / spectrum.sd_log;
    density[i] = std::exp(-z * z / 2);
  }
  return density;
}

std::vector<OnGrid> PositiveSensitivities::of_medians(double sd_log) const {
  constexpr double impossible = -1e6;
  std::vector<OnGrid> all(densities_.size());
  for (OnGrid& one : all) one.fill(impossible);
  for (std::size_t i = 0; i < n_places; ++i) {
    const OnPlaces prior = density_of({logs_[i], sd_log});
    for (std::size_t person = 0; person < all.size(); ++person) {
      double weight = 0;
      for (std::size_t k = 0; k < n_places; ++k) weight += densities_[person][k] * prior[k];
      all[person][first_place + i] = std::log(std::max(weight, 1e-300));
    }
  }
  return all;
}

std::vector<std::vector<double>> PositiveSensitivities::posteriors(const Spectrum& spectrum) const {
  const OnPlaces prior = density_of(spectrum);
  std::vector<std::vector<double>> all;
  for (const OnPlaces& density : densities_) {
    std::vector<double>& weights = all.emplace_back(n_places);
    double sum = 0;
    for (std::size_t i = 0; i < n_places; ++i) sum += weights[i] = density[i] * prior[i];
    if (sum > 0)
      for (double& weight : weights) weight /= sum;
  }
  return all;
}

Spectrum PositiveSensitivities::fit(Spectrum from, int n_steps) const {
  constexpr double least_sd = 0.1, most_sd = 1.5;  // finer than the grid
  for (int step = 0; step < n_steps; ++step) {
    double n = 0, sum = 0, square = 0;
    for (const std::vector<double>& weights : posteriors(from))
      for (std::size_t i = 0; i < n_places; ++i) {
        n += weights[i];
        sum += weights[i] * logs_[i];
        square += weights[i] * logs_[i] * logs_[i];
      }
    if (n == 0) break;
    from.mean_log = sum / n;
    const double variance = std::max(square / n - from.mean_log * from.mean_log, 0.0);
    from.sd_log = std::clamp(std::sqrt(variance), least_sd, most_sd);
  }
  return from;
}

SpreadSensitivities spread_sensitivities(std::vector<PersonAnswers> people, double place) {
  constexpr int n_steps = 5;
  const auto from =
      std::clamp(static_cast<std::size_t>(std::lround(place)), first_place, n_grid - 1);
  Spread spread;
  fit_criteria(people, sensitivity_at(static_cast<double>(from)), spread);
  SpreadSensitivities found;
  found.spectrum.mean_log = std::log(sensitivity_at(place));
  for (int step = 0; step < n_steps; ++step) {
    std::vector<LikelyOnPlaces> likely;
    found.log_likelihood.clear();
    for (const PersonAnswers& person : people) {
      likely.push_back(on_places(person, from, spread));
      found.log_likelihood.push_back(log_likelihood_of(likely.back()));
    }
    const PositiveSensitivities positive(found.log_likelihood);
    found.spectrum = positive.fit(found.spectrum, 60);
    spread = next_spread(spread, likely, positive.posteriors(found.spectrum));
  }
  return found;
}

}  // namespace heft
