#include "analysis/PooledSensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/CriteriaFit.h"
#include "analysis/MaximumLikelihood.h"
#include "base/Quantile.h"
#include "base/Random.h"
#include "psychophysics/Normal.h"

namespace heft {

namespace {

// Sensitivities per largest level: dense around 0, and up to thresholds of a four-hundredth of it.
constexpr std::size_t n_grid = 56;
constexpr double first_place = -4, place_step = 0.2;
constexpr std::size_t no_sensitivity = 20;
double sensitivity_at(double place) {
  return 0.5 * std::sinh(first_place + place_step * place);
}

using OnGrid = std::array<double, n_grid>;

// By person, for each sensitivity on the grid.
struct Profiles {
  std::vector<OnGrid> log_likelihood, log_indecision;
};

// A person's log indecision as their answers alone have it: what was drawn towards the others' by
// the spread goes back, for all by the same factor.
void put_log_indecisions(std::vector<OnGrid>& all, std::size_t place,
                         const std::vector<PersonAnswers>& people) {
  double sum = 0, told = 0;
  for (const PersonAnswers& person : people) {
    sum += person.criteria.log_indecision;
    told += person.told;
  }
  const double n = static_cast<double>(people.size());
  constexpr double least_told = 0.02;
  const double factor = 1 / std::max(told / n, least_told);
  for (std::size_t i = 0; i < people.size(); ++i)
    all[i][place] = sum / n + factor * (people[i].criteria.log_indecision - sum / n);
}

Profiles profiles(std::vector<PersonAnswers>& people) {
  Profiles all{std::vector<OnGrid>(people.size()), std::vector<OnGrid>(people.size())};
  Spread spread;
  const auto put = [&](std::size_t place) {
    const double sensitivity = sensitivity_at(static_cast<double>(place));
    const std::vector<double> values = fit_criteria(people, sensitivity, spread);
    for (std::size_t i = 0; i < people.size(); ++i) all.log_likelihood[i][place] = values[i];
    put_log_indecisions(all.log_indecision, place, people);
  };
  // From no sensitivity outwards, each place from where its neighbor found the criteria: where all
  // choices pass for lapses is another hill, far from the right one.
  for (int i = 0; i < 3; ++i) put(no_sensitivity);
  const std::vector<PersonAnswers> people_there = people;
  const Spread spread_there = spread;
  for (std::size_t place = no_sensitivity; place-- > 0;) put(place);
  people = people_there;
  spread = spread_there;
  for (std::size_t place = no_sensitivity + 1; place < n_grid; ++place) {
    const double place_before = static_cast<double>(place - 1);
    move_criteria(people, spread, sensitivity_at(place_before + 1) / sensitivity_at(place_before));
    put(place);
  }
  return all;
}

/// The place on the grid where a sum is highest, by the parabola through the three highest.
double top_of(const OnGrid& sum) {
  const auto best = static_cast<std::size_t>(std::ranges::max_element(sum) - sum.begin());
  if (best == 0 || best + 1 == n_grid) return static_cast<double>(best);
  const double before = sum[best - 1], here = sum[best], after = sum[best + 1];
  const double bend = before - 2 * here + after;
  return static_cast<double>(best) + (bend < 0 ? (before - after) / (2 * bend) : 0);
}

void add(OnGrid& sum, const OnGrid& more, double times) {
  for (std::size_t i = 0; i < n_grid; ++i) sum[i] += times * more[i];
}

// Each person as often as `times` says.
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

/// How sensitivities are spread between people: their logarithm is normal.
struct Spectrum {
  double mean_log = 0, sd_log = 0.3;
};

// The likelihood of each person's sensitivities above none, as a density over their logarithm.
class PositiveSensitivities {
 public:
  explicit PositiveSensitivities(std::span<const OnGrid> people) {
    for (std::size_t i = 0; i < n_places; ++i) logs_[i] = std::log(sensitivity_at(place(i)));
    for (const OnGrid& person : people) {
      const double best = *std::ranges::max_element(person);
      OnPlaces density{};
      for (std::size_t i = 0; i < n_places; ++i)
        density[i] = std::exp(person[no_sensitivity + 1 + i] - best) * width(i);
      densities_.push_back(density);
    }
  }

  /// By person: log likelihoods of medians on the grid, where people are spread so much. What is
  /// not above none can't be.
  std::vector<OnGrid> of_medians(double sd_log) const {
    constexpr double impossible = -1e6;
    std::vector<OnGrid> all(densities_.size());
    for (OnGrid& one : all) one.fill(impossible);
    for (std::size_t i = 0; i < n_places; ++i) {
      const OnPlaces prior = density_of({logs_[i], sd_log});
      for (std::size_t person = 0; person < all.size(); ++person) {
        double weight = 0;
        for (std::size_t k = 0; k < n_places; ++k) weight += densities_[person][k] * prior[k];
        all[person][no_sensitivity + 1 + i] = std::log(std::max(weight, 1e-300));
      }
    }
    return all;
  }

  /// By the EM algorithm.
  Spectrum fit(Spectrum from, int n_steps) const {
    constexpr double least_sd = 0.1, most_sd = 1.5;  // finer than the grid tells nothing
    for (int step = 0; step < n_steps; ++step) {
      const OnPlaces prior = density_of(from);
      double n = 0, sum = 0, square = 0;
      for (const OnPlaces& density : densities_) {
        double weight = 0, first = 0, second = 0;
        for (std::size_t i = 0; i < n_places; ++i) {
          const double w = density[i] * prior[i];
          weight += w;
          first += w * logs_[i];
          second += w * logs_[i] * logs_[i];
        }
        if (!(weight > 0)) continue;
        n += 1;
        sum += first / weight;
        square += second / weight;
      }
      if (n == 0) break;
      from.mean_log = sum / n;
      const double variance = std::max(square / n - from.mean_log * from.mean_log, 0.0);
      from.sd_log = std::clamp(std::sqrt(variance), least_sd, most_sd);
    }
    return from;
  }

 private:
  static constexpr std::size_t n_places = n_grid - no_sensitivity - 1;
  using OnPlaces = std::array<double, n_places>;

  static double place(std::size_t i) { return static_cast<double>(no_sensitivity + 1 + i); }
  double width(std::size_t i) const {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n_places - 1);
    return (logs_[after] - logs_[before]) / static_cast<double>(after - before);
  }
  OnPlaces density_of(const Spectrum& spectrum) const {
    OnPlaces density{};
    for (std::size_t i = 0; i < n_places; ++i) {
      const double z = (logs_[i] - spectrum.mean_log) / spectrum.sd_log;
      density[i] = std::exp(-z * z / 2);
    }
    return density;
  }

  OnPlaces logs_{};
  std::vector<OnPlaces> densities_;
};

constexpr int n_samples = 2000;

// A figure of samples of people, always of the same. @param figure_of how often each was drawn
template <typename Figure>
std::vector<double> bootstrap(std::size_t n_people, Figure figure_of) {
  RandomStream stream(1, "sample of people");
  std::vector<double> figures, times(n_people);
  for (int sample = 0; sample < n_samples; ++sample) {
    std::ranges::fill(times, 0.0);
    for (std::size_t i = 0; i < n_people; ++i) times[stream.below(n_people)] += 1;
    figures.push_back(figure_of(times));
  }
  return figures;
}

std::vector<double> sensitivities_of_samples(std::span<const OnGrid> people) {
  return bootstrap(people.size(), [&](const std::vector<double>& times) {
    return sensitivity_at(top_of(sum_of(people, times)));
  });
}

// Of the median person, at the sensitivity that these have in common.
double log_indecision_of(const Profiles& people, std::span<const double> times) {
  const double place = top_of(sum_of(people.log_likelihood, times));
  return between_places(sum_of(people.log_indecision, times), place) /
         static_cast<double>(times.size());
}

double largest_level(std::span<const AnswersByLevel> people) {
  double largest_g = 0;
  for (const AnswersByLevel& answers : people)
    largest_g = std::max(largest_g, largest_level_of(answers));
  return largest_g;
}

// Where the grid ends, more would fit as well.
bool is_separated(const PooledSensitivity& found, double largest_g) {
  return found.sensitivity_interval->low > 0 &&
         *found.sensitivity * largest_g >= 0.5 * sensitivity_at(n_grid - 1);
}

std::vector<SidedAnswers> answers_on_scale(const AnswersByLevel& by_level, double largest_g) {
  std::vector<SidedAnswers> answers;
  for (const auto& [level_g, n] : by_level)
    answers.push_back({level_g / largest_g, n[0], n[1], n[2]});
  return answers;
}

// Of one person alone: where the likelihood itself says.
void put_own_interval(PooledSensitivity& found, const AnswersByLevel& answers) {
  const Fit fit = fit_indecision(answers, {.lapse = fixed_lapse});
  const FittedParameter& s = fit.parameter("sensitivity");
  found.why = fit.why;
  found.sensitivity = s.value;
  if (s.low && s.high) found.sensitivity_interval = Interval{*s.low, *s.high};
  if (!found.identifiable()) return;
  const FittedParameter& threshold = fit.parameter("threshold_75_g");
  found.threshold_75_g = threshold.value;
  found.threshold_interval_g = Interval{threshold.low.value_or(0), *threshold.high};
}

// First what all have in common, which says whether there is any. Then the median of people who
// differ.
void put_pooled(PooledSensitivity& found, std::span<const OnGrid> people, double largest_g) {
  std::vector<double> samples = sensitivities_of_samples(people);
  Interval interval = expanded_percentiles(samples, people.size());
  if (interval.low > 0) {
    const PositiveSensitivities positive(people);
    const Spectrum all = positive.fit({std::log(*found.sensitivity * largest_g), 0.3}, 60);
    found.sd_log_sensitivity = all.sd_log;
    const std::vector<OnGrid> of_medians = positive.of_medians(all.sd_log);
    const std::vector<double> once(people.size(), 1);
    found.sensitivity = sensitivity_at(top_of(sum_of(of_medians, once))) / largest_g;
    samples = sensitivities_of_samples(of_medians);
    interval = expanded_percentiles(samples, people.size());
  }
  for (double& sample : samples) sample /= largest_g;
  found.sensitivity_samples = std::move(samples);
  found.sensitivity_interval = Interval{interval.low / largest_g, interval.high / largest_g};
  found.why = why_no_threshold(is_separated(found, largest_g), found.sensitivity_interval->low,
                               found.sensitivity_interval->high, largest_g);
  if (!found.identifiable()) return;
  found.threshold_75_g = z_75 / *found.sensitivity;
  found.threshold_interval_g =
      Interval{z_75 / found.sensitivity_interval->high, z_75 / found.sensitivity_interval->low};
}

// Where a likelihood has fallen far enough, a place on the grid; none: nowhere on this side.
std::optional<double> end_of(const OnGrid& log_likelihood, std::ptrdiff_t direction) {
  const auto best = std::ranges::max_element(log_likelihood);
  const double least = *best - interval_drop;
  const auto last = direction < 0 ? log_likelihood.begin() : log_likelihood.end() - 1;
  for (auto inner = best; inner != last; inner += direction) {
    const double here = *inner, next = *(inner + direction);
    if (next <= least)
      return static_cast<double>(inner - log_likelihood.begin()) +
             static_cast<double>(direction) * (here - least) / (here - next);
  }
  return std::nullopt;
}

OwnSensitivity own_sensitivity(const OnGrid& log_likelihood, double largest_g) {
  const auto at = [largest_g](double place) { return sensitivity_at(place) / largest_g; };
  OwnSensitivity own{at(top_of(log_likelihood))};
  if (const auto place = end_of(log_likelihood, -1)) own.low = at(*place);
  if (const auto place = end_of(log_likelihood, 1)) own.high = at(*place);
  return own;
}

void put_indecision(PooledSensitivity& found, const Profiles& people) {
  const std::size_t n = people.log_indecision.size();
  found.indecision = std::exp(log_indecision_of(people, std::vector<double>(n, 1)));
  if (found.n < least_people) return;
  const Interval logs = expanded_percentiles(
      bootstrap(n,
                [&](const std::vector<double>& times) { return log_indecision_of(people, times); }),
      n);
  found.indecision_interval = Interval{std::exp(logs.low), std::exp(logs.high)};
}
}  // namespace

Interval expanded_percentiles(const std::vector<double>& samples, std::size_t n_people,
                              double confidence) {
  const double n = static_cast<double>(n_people);
  const double t = student_t_quantile(n - 1, confidence);
  const double tail = normal_cdf(-t * std::sqrt(n / (n - 1)));
  return {*heft::quantile(samples, tail), *heft::quantile(samples, 1 - tail)};
}

PooledSensitivity pooled_sensitivity(std::span<const AnswersByLevel> all) {
  PooledSensitivity found;
  std::vector<AnswersByLevel> with_trials;
  for (const AnswersByLevel& answers : all)
    if (trials_in(answers) > 0) with_trials.push_back(answers);
  for (const AnswersByLevel& answers : with_trials) found.n_trials += trials_in(answers);
  found.n = static_cast<int>(with_trials.size());
  const double largest_g = largest_level(with_trials);
  if (largest_g == 0) {
    found.why = found.n == 0 ? "there are no trials" : "no trial had a difference";
    return found;
  }
  std::vector<PersonAnswers> people;
  for (const AnswersByLevel& answers : with_trials)
    people.push_back({answers_on_scale(answers, largest_g), {}});
  const Profiles by_person = profiles(people);
  const std::vector<double> once(people.size(), 1);
  found.sensitivity = sensitivity_at(top_of(sum_of(by_person.log_likelihood, once))) / largest_g;
  put_indecision(found, by_person);
  if (found.n >= least_people)
    for (const OnGrid& one : by_person.log_likelihood)
      found.people.push_back(own_sensitivity(one, largest_g));
  if (found.n == 1)
    put_own_interval(found, with_trials[0]);
  else if (found.n >= least_people)
    put_pooled(found, by_person.log_likelihood, largest_g);
  else
    found.why =
        fmt::format("{} participants are too few to tell how people differ, expected {} or more",
                    found.n, least_people);
  return found;
}

}  // namespace heft
