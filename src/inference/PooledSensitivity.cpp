#include "inference/PooledSensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/Random.h"
#include "base/math/Quantiles.h"
#include "inference/CriteriaFit.h"
#include "inference/MaximumLikelihood.h"
#include "inference/SensitivitySpread.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {

// By person, for each sensitivity on the grid.
struct Profiles {
  std::vector<OnGrid> log_likelihood, log_indecision;
};

// A person's log indecision as their answers alone have it: what was drawn towards the others' by
// the spread goes back, for all by the same factor.
void put_log_indecisions(std::vector<OnGrid>& all, std::size_t place,
                         const std::vector<PersonAnswers>& people) {
  double sum = 0, information = 0;
  for (const PersonAnswers& person : people) {
    sum += person.criteria.log_indecision;
    information += person.information;
  }
  const double n = static_cast<double>(people.size());
  constexpr double min_information = 0.02;
  const double factor = 1 / std::max(information / n, min_information);
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

constexpr std::size_t n_samples = 2000;

/// Draws people of a whole study: who was not at this reference counts for nothing here.
class Samples {
 public:
  /// @param study who was in the study, all of `people` among them
  Samples(const std::map<std::string, AnswersByLevel>& people, const std::set<std::string>& study)
      : n_in_study_(study.size()) {
    for (const auto& [participant, answers] : people)
      places_.push_back(
          static_cast<std::size_t>(std::distance(study.begin(), study.find(participant))));
  }

  std::size_t n_people() const { return places_.size(); }

  /// A figure of each sample, always of the same. @param figure_of how often each was drawn
  template <typename Figure>
  std::vector<double> figures(Figure figure_of) const {
    RandomStream stream(1, "sample of people");
    std::vector<double> all, drawn(n_in_study_), times(n_people());
    while (all.size() < n_samples) {
      std::ranges::fill(drawn, 0.0);
      for (std::size_t i = 0; i < n_in_study_; ++i) drawn[stream.below(n_in_study_)] += 1;
      double n = 0;
      for (std::size_t i = 0; i < n_people(); ++i) n += times[i] = drawn[places_[i]];
      all.push_back(n > 0 ? figure_of(times) : all.empty() ? figure_of(once()) : all.back());
    }
    return all;
  }

  std::vector<double> once() const { return std::vector<double>(n_people(), 1); }

 private:
  std::size_t n_in_study_;
  std::vector<std::size_t> places_;  // by person: among those of the study
};

// Where a likelihood has fallen far enough, a place on the grid; none: nowhere on this side.
std::optional<double> end_of(const OnGrid& log_likelihood, double drop, std::ptrdiff_t direction) {
  const auto best = std::ranges::max_element(log_likelihood);
  const double least = *best - drop;
  const auto last = direction < 0 ? log_likelihood.begin() : log_likelihood.end() - 1;
  for (auto inner = best; inner != last; inner += direction) {
    const double here = *inner, next = *(inner + direction);
    if (next <= least)
      return static_cast<double>(inner - log_likelihood.begin()) +
             static_cast<double>(direction) * (here - least) / (here - next);
  }
  return std::nullopt;
}

// No sensitivity on the grid is ruled out.
bool is_flat(const OnGrid& log_likelihood) {
  const auto [least, most] = std::ranges::minmax(log_likelihood);
  return most - least < interval_drop;
}

// Of people who are drawn so often, what is likeliest together.
double sensitivity_of(std::span<const OnGrid> people, std::span<const double> times) {
  return sensitivity_at(top_of(sum_of(people, times)));
}

std::vector<double> sensitivities_of(std::span<const OnGrid> people, const Samples& samples) {
  return samples.figures(
      [&](const std::vector<double>& times) { return sensitivity_of(people, times); });
}

// Of the median person, at the sensitivity that these have in common.
double log_indecision_of(const Profiles& people, std::span<const double> times) {
  const double place = top_of(sum_of(people.log_likelihood, times));
  return between_places(sum_of(people.log_indecision, times), place) /
         std::accumulate(times.begin(), times.end(), 0.0);
}

AnswersByLevel together(const std::map<std::string, AnswersByLevel>& people) {
  AnswersByLevel sum;
  for (const auto& [participant, answers] : people)
    for (const auto& [level_g, n] : answers)
      for (std::size_t k = 0; k < n.size(); ++k) sum[level_g][k] += n[k];
  return sum;
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
  if (!s.value) found.indecision.reset();
  if (s.low && s.high) found.sensitivity_interval = Interval{*s.low, *s.high};
  if (!found.identifiable()) return;
  const FittedParameter& threshold = fit.parameter("threshold_75_g");
  found.threshold_75_g = threshold.value;
  found.threshold_interval_g = Interval{threshold.low.value_or(0), *threshold.high};
}

// The median of people who differ, and samples of it: of these the spread of sensitivities and that
// of criteria are not refitted, which would take minutes, but their center is put where it
// is.
std::vector<double> put_median(PooledSensitivity& found, std::span<const OnGrid> in_common,
                               const std::vector<PersonAnswers>& people, const Samples& samples) {
  const std::vector<double> once = samples.once();
  const SpreadSensitivities apart = spread_sensitivities(people, top_of(sum_of(in_common, once)));
  const double sd_log = apart.spectrum.sd_log;
  const std::vector<OnGrid> of_medians =
      PositiveSensitivities(apart.log_likelihood).of_medians(sd_log);
  const std::vector<OnGrid> together = PositiveSensitivities(in_common).of_medians(sd_log);
  found.sd_log_sensitivity = sd_log;
  found.sensitivity = sensitivity_of(of_medians, once);
  const double shift = *found.sensitivity / sensitivity_of(together, once);
  std::vector<double> figures = sensitivities_of(together, samples);
  for (double& figure : figures) figure *= shift;
  return figures;
}

// First what all have in common, which says whether there is any.
void put_pooled(PooledSensitivity& found, std::span<const OnGrid> in_common,
                const std::vector<PersonAnswers>& people, const Samples& drawn, double largest_g) {
  std::vector<double> samples = sensitivities_of(in_common, drawn);
  found.sensitivity = sensitivity_of(in_common, drawn.once());
  found.sensitivity_interval = expanded_percentiles(samples, people.size());
  if (found.sensitivity_interval->low > 0) {
    samples = put_median(found, in_common, people, drawn);
    found.sensitivity_interval =
        symmetric_interval(*found.sensitivity, samples, people.size(), confidence_level);
  }
  for (double* figure :
       {&*found.sensitivity, &found.sensitivity_interval->low, &found.sensitivity_interval->high})
    *figure /= largest_g;
  for (double& sample : samples) sample /= largest_g;
  found.sensitivity_samples = std::move(samples);
  const auto [low, high] = *found.sensitivity_interval;
  const bool has_end = end_of(sum_of(in_common, drawn.once()), interval_drop, 1).has_value();
  found.why = why_no_threshold({low, high, low > 0 && !has_end}, {largest_g});
  if (!found.identifiable()) return;
  found.threshold_75_g = z_75 / *found.sensitivity;
  found.threshold_interval_g =
      Interval{z_75 / found.sensitivity_interval->high, z_75 / found.sensitivity_interval->low};
}

// As far as Student's t goes instead of the normal distribution, with a degree of freedom less for
// sensitivity, indecision and bias each: of 30 trials the chi-square quantile holds too little.
double drop_of(double n_trials) {
  const double t = student_t_quantile(std::max(n_trials - 3, 1.0), confidence_level);
  return t * t / 2;
}

OwnSensitivity own_sensitivity(const OnGrid& log_likelihood, double n_trials, double largest_g) {
  const double drop = drop_of(n_trials);
  const auto at = [largest_g](double place) { return sensitivity_at(place) / largest_g; };
  OwnSensitivity own{at(top_of(log_likelihood))};
  if (const auto place = end_of(log_likelihood, drop, -1)) own.low = at(*place);
  if (const auto place = end_of(log_likelihood, drop, 1)) own.high = at(*place);
  return own;
}

// Beyond which percentiles lie, farther out where people are few.
double expanded_tail(std::size_t n_people, double confidence) {
  const double n = static_cast<double>(n_people);
  return normal_cdf(-student_t_quantile(n - 1, confidence) * std::sqrt(n / (n - 1)));
}

void put_indecision(PooledSensitivity& found, const Profiles& people, const Samples& samples) {
  found.indecision = std::exp(log_indecision_of(people, samples.once()));
  if (found.n < least_people) return;
  const Interval logs = expanded_percentiles(samples.figures([&](const std::vector<double>& times) {
    return log_indecision_of(people, times);
  }),
                                             samples.n_people());
  found.indecision_interval = Interval{std::exp(logs.low), std::exp(logs.high)};
}
}  // namespace

Interval expanded_percentiles(const std::vector<double>& samples, std::size_t n_people,
                              double confidence) {
  const double tail = expanded_tail(n_people, confidence);
  return {*heft::quantile(samples, tail), *heft::quantile(samples, 1 - tail)};
}

Interval symmetric_interval(double estimate, const std::vector<double>& samples,
                            std::size_t n_people, double confidence) {
  std::vector<double> distances;
  for (const double sample : samples) distances.push_back(std::abs(std::log(sample / estimate)));
  const double half = *heft::quantile(distances, 1 - 2 * expanded_tail(n_people, confidence));
  return {estimate * std::exp(-half), estimate * std::exp(half)};
}

PooledSensitivity pooled_sensitivity(std::map<std::string, AnswersByLevel> all,
                                     const std::set<std::string>& study) {
  PooledSensitivity found;
  std::erase_if(all, [](const auto& person) { return trials_in(person.second) == 0; });
  const AnswersByLevel answers_of_all = together(all);
  found.n_trials = trials_in(answers_of_all);
  found.n = static_cast<int>(all.size());
  const double largest_g = largest_level_of(answers_of_all);
  found.why = found.n > 0 && largest_g == 0 ? "no trial had a difference"
                                            : too_little_chosen(answers_of_all);
  if (!found.identifiable()) return found;
  const Samples samples(all, study);
  std::vector<PersonAnswers> people;
  for (const auto& [participant, answers] : all)
    people.push_back({answers_on_scale(answers, largest_g), {}});
  const Profiles by_person = profiles(people);
  if (found.n >= least_people)
    for (std::size_t i = 0; const auto& [participant, answers] : all)
      found.people[participant] =
          own_sensitivity(by_person.log_likelihood[i++], trials_in(answers), largest_g);
  if (found.n > 1 && is_flat(sum_of(by_person.log_likelihood, samples.once()))) {
    found.why = why_no_threshold({}, {largest_g});
    return found;
  }
  found.sensitivity = sensitivity_of(by_person.log_likelihood, samples.once()) / largest_g;
  put_indecision(found, by_person, samples);
  if (found.n == 1)
    put_own_interval(found, all.begin()->second);
  else if (found.n >= least_people)
    put_pooled(found, by_person.log_likelihood, people, samples, largest_g);
  else
    found.why = fmt::format(
        "{} participants are too few to estimate how people differ, expected {} or more", found.n,
        least_people);
  return found;
}

OwnThreshold own_threshold(const AnswersByLevel& answers, const OwnSensitivity* own) {
  if (own == nullptr) {
    const Fit fit = fit_indecision(answers, {.lapse = fixed_lapse});
    if (!fit.identifiable()) return {{}, {}, fit.why};
    const FittedParameter& threshold = fit.parameter("threshold_75_g");
    return {threshold.value, Interval{threshold.low.value_or(0), *threshold.high}, ""};
  }
  std::string why = too_little_chosen(answers);
  const bool separated = !own->high && own->low.value_or(0) > 0;
  if (why.empty())
    why = why_no_threshold({own->low, own->high, separated}, {largest_level_of(answers)});
  if (!why.empty()) return {{}, {}, why};
  return {z_75 / own->value, Interval{z_75 / *own->high, z_75 / *own->low}, ""};
}

Interval threshold_ratio_interval(const PooledSensitivity& first, const PooledSensitivity& second,
                                  double confidence) {
  std::vector<double> ratios;
  const std::size_t n =
      std::min(first.sensitivity_samples.size(), second.sensitivity_samples.size());
  for (std::size_t i = 0; i < n; ++i)
    ratios.push_back(first.sensitivity_samples[i] / second.sensitivity_samples[i]);
  return symmetric_interval(*first.sensitivity / *second.sensitivity, ratios,
                            static_cast<std::size_t>(std::min(first.n, second.n)), confidence);
}

}  // namespace heft
