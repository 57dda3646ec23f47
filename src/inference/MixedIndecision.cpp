#include "inference/MixedIndecision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/Parallel.h"
#include "inference/PopulationLikelihood.h"

namespace heft {

namespace {
AnswersByLevel together(const AnswersByPerson& people) {
  AnswersByLevel sum;
  for (const auto& [participant, answers] : people)
    for (const auto& [level_g, n] : answers)
      for (std::size_t k = 0; k < n.size(); ++k) sum[level_g][k] += n[k];
  return sum;
}

// Levels in units of the largest one; mirrored: with opposite sign.
std::vector<LevelAnswers> on_scale(const AnswersByLevel& by_level, double largest_g,
                                   bool mirrored = false) {
  std::vector<LevelAnswers> answers;
  for (const auto& [level_g, n] : by_level)
    answers.push_back({(mirrored ? -level_g : level_g) / largest_g, n});
  return answers;
}

std::vector<std::vector<LevelAnswers>> on_scale(const AnswersByPerson& people, double largest_g,
                                                bool mirrored = false) {
  std::vector<std::vector<LevelAnswers>> all;
  for (const auto& [participant, answers] : people)
    all.push_back(on_scale(answers, largest_g, mirrored));
  return all;
}

/// Sensitivities per largest level: dense around 0, and up to thresholds of a four-hundredth of it.
constexpr std::size_t n_places = 56, place_of_0 = 20;
constexpr double dense = 0.5, place_width = 0.2;
double sensitivity_at(double place) {
  return dense * std::sinh(place_width * (place - static_cast<double>(place_of_0)));
}
double place_of(double sensitivity) {
  return static_cast<double>(place_of_0) + std::asinh(sensitivity / dense) / place_width;
}
using Profile = std::array<double, n_places>;

// One person's log likelihood by sensitivity, if all people of the population had it. The
// criterion's distribution does not depend on it. Steps outward from the population's sensitivity
// until the likelihood is negligible.
Profile profile_of(const AnswersByLevel& by_level, double largest_g, Parameters population) {
  constexpr double none = -9;  // log of a sensitivity that is as good as 0
  constexpr double far_less = 15;
  const double of_population = std::exp(population[mean_log_sensitivity]);
  population[arctanh_correlation] = 0;
  population[log_sd_sensitivity] = std::log(1e-3);
  Profile profile;
  profile.fill(-infinity);
  double most = -infinity;
  // @return whether the likelihood is not negligible
  const auto put = [&](PersonIntegral& person, std::size_t place) {
    const double s = std::abs(sensitivity_at(static_cast<double>(place)));
    population[mean_log_sensitivity] = s > 0 ? std::log(s) : none;
    person.center(population);
    profile[place] = person.log_likelihood(population, nullptr);
    most = std::max(most, profile[place]);
    return profile[place] > most - far_less;
  };
  PersonIntegral upwards(on_scale(by_level, largest_g));
  PersonIntegral downwards(on_scale(by_level, largest_g, true));
  const auto start = static_cast<std::size_t>(std::min(place_of(of_population), n_places - 1.0));
  for (std::size_t place = start; place < n_places && put(upwards, place);) ++place;
  for (std::size_t place = start; place-- > 0;)
    if (!put(place < place_of_0 ? downwards : upwards, place)) break;
  return profile;
}

// The place of the maximum, by a parabola through the three highest values.
double top_of(const Profile& values) {
  const auto best = std::ranges::max_element(values);
  const double place = static_cast<double>(best - values.begin());
  if (best == values.begin() || best == values.end() - 1) return place;
  const double before = *(best - 1), after = *(best + 1), curvature = before - 2 * *best + after;
  return curvature < 0 ? place + (before - after) / (2 * curvature) : place;
}

// The place at which the likelihood has fallen by `drop`; none: it never does on this side.
std::optional<double> end_of(const Profile& values, double drop, std::ptrdiff_t direction) {
  const auto best = std::ranges::max_element(values);
  const double least = *best - drop;
  const auto last = direction < 0 ? values.begin() : values.end() - 1;
  for (auto inner = best; inner != last; inner += direction) {
    const double here = *inner, next = *(inner + direction);
    if (next <= least)
      return static_cast<double>(inner - values.begin()) +
             static_cast<double>(direction) * (here - least) / (here - next);
  }
  return std::nullopt;
}

// The fall of the log likelihood for Student's t instead of the normal distribution, with three
// degrees of freedom less, for sensitivity, criterion and bias: with 30 trials, intervals by the
// chi-square quantile cover too little.
double drop_of(double n_trials) {
  const double t = student_t_quantile(std::max(n_trials - 3, 1.0), confidence_level);
  return t * t / 2;
}

OwnSensitivity own_sensitivity(const AnswersByLevel& answers, double largest_g,
                               const Parameters& population) {
  const Profile profile = profile_of(answers, largest_g, population);
  const double drop = drop_of(trials_in(answers));
  const auto at = [largest_g](double place) { return sensitivity_at(place) / largest_g; };
  OwnSensitivity own{at(top_of(profile))};
  if (const auto place = end_of(profile, drop, -1)) own.low = at(*place);
  if (const auto place = end_of(profile, drop, 1)) own.high = at(*place);
  return own;
}

std::map<std::string, OwnSensitivity> own_sensitivities(const AnswersByPerson& people,
                                                        double largest_g,
                                                        const Parameters& population) {
  std::vector<const AnswersByLevel*> answers;
  for (const auto& [participant, theirs] : people) answers.push_back(&theirs);
  std::vector<OwnSensitivity> found(answers.size());
  in_parallel(answers.size(), 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      found[i] = own_sensitivity(*answers[i], largest_g, population);
  });
  std::map<std::string, OwnSensitivity> all;
  for (std::size_t i = 0; const auto& [participant, theirs] : people)
    all.emplace_hint(all.end(), participant, found[i++]);
  return all;
}

MixedFigure figure(double log_value, const PopulationLikelihood::ProfileInterval& logs,
                   double unit = 1) {
  MixedFigure found{std::exp(log_value) * unit};
  if (logs.low) found.low = std::exp(*logs.low) * unit;
  if (logs.high) found.high = std::exp(*logs.high) * unit;
  return found;
}

// A single person: the fit of their answers alone.
void put_single(MixedFit& found, const AnswersByLevel& answers) {
  const Fit fit = fit_indecision(answers, {.lapse = fixed_lapse});
  const auto put = [&](std::optional<MixedFigure>& into, const char* name) {
    const FittedParameter& one = fit.parameter(name);
    if (one.value) into = MixedFigure{*one.value, one.low, one.high};
  };
  found.why = fit.why;
  found.log_likelihood = fit.log_likelihood.value_or(0);
  put(found.sensitivity, "sensitivity");
  if (found.sensitivity) put(found.indecision, "indecision");
  if (found.identifiable()) put(found.threshold_75_g, "threshold_75_g");
}

// Interval of the sensitivity per g. If a sensitivity of 0 is likely, answers may be opposite to
// the levels: then the fit of the mirrored answers decides whether it is negative.
SensitivityRange range_of(const PopulationLikelihood::ProfileInterval& logs,
                          const AnswersByPerson& people, double largest_g) {
  const auto per_g = [largest_g](const std::optional<double>& log_sensitivity) {
    return log_sensitivity ? std::optional(std::exp(*log_sensitivity) / largest_g) : std::nullopt;
  };
  if (logs.low || !logs.high) return {per_g(logs.low), per_g(logs.high)};
  PopulationLikelihood mirrored(on_scale(people, largest_g, true));
  const Maximum down = mirrored.maximum();
  if (mirrored.excludes_no_sensitivity(down))
    return {std::nullopt, -std::exp(down.at[mean_log_sensitivity]) / largest_g};
  return {std::nullopt, per_g(logs.high)};
}

// Standard error by the infinitesimal jackknife.
double jackknife_error(const std::vector<double>& influences) {
  const auto n = static_cast<double>(influences.size());
  double square = 0;
  for (const double influence : influences) square += influence * influence;
  return std::sqrt(square * n / (n - 1));
}

// Scaled to the width of the profile interval: the jackknife's own standard error is too small
// where people have few trials (its interval covered 88 to 94 %).
void put_influence(MixedFit& found, const AnswersByPerson& people,
                   const std::vector<double>& influences) {
  const double half_width = std::log(*found.threshold_75_g->high / *found.threshold_75_g->low) / 2;
  const double se = half_width / student_t_quantile(found.n - 1);
  const double scale = -se / jackknife_error(influences);  // of the threshold, not sensitivity
  for (std::size_t i = 0; const auto& [participant, answers] : people)
    found.influence[participant] = scale * influences[i++];
}

struct PopulationEstimate {
  Maximum best;
  PopulationLikelihood::ProfileInterval log_sensitivity, log_criterion, lapse;
  std::vector<double> influences;
  std::vector<ThresholdAtLapse> at_lapse;
};

// The likelihood, which takes much memory, exists in this function only.
PopulationEstimate estimate_population(const AnswersByPerson& people, double largest_g) {
  PopulationLikelihood likelihood(on_scale(people, largest_g));
  PopulationEstimate found{likelihood.maximum(), {}, {}, {}, {}, {}};
  found.log_sensitivity = likelihood.interval(found.best, mean_log_sensitivity);
  if (!found.log_sensitivity.high) return found;  // nor are there criteria
  found.log_criterion = likelihood.interval(found.best, mean_log_criterion);
  found.lapse = likelihood.interval(found.best, shared_lapse);
  found.influences = likelihood.influences(found.best, mean_log_sensitivity);
  if (found.lapse.high) return found;
  for (const double rate : {0.0, 0.02, 0.05}) {
    Parameters at = found.best.at;
    at[shared_lapse] = rate;
    const Maximum near = likelihood.climb(std::move(at), shared_lapse);
    const Maximum there = likelier(near, likelihood.maximum(rate));
    found.at_lapse.push_back({rate, z_75 * largest_g * std::exp(-there.at[mean_log_sensitivity])});
  }
  return found;
}

void put_population(MixedFit& found, const AnswersByPerson& people, double largest_g) {
  const PopulationEstimate population = estimate_population(people, largest_g);
  const Parameters& at = population.best.at;
  found.why =
      why_no_threshold(range_of(population.log_sensitivity, people, largest_g), {largest_g});
  if (!population.log_sensitivity.high) return;
  found.log_likelihood = population.best.log_likelihood;
  found.people = own_sensitivities(people, largest_g, at);
  found.indecision = figure(at[mean_log_criterion], population.log_criterion);
  found.lapse =
      MixedFigure{at[shared_lapse], population.lapse.low.value_or(0), population.lapse.high};
  if (!found.identifiable()) return;
  found.sensitivity = figure(at[mean_log_sensitivity], population.log_sensitivity, 1 / largest_g);
  found.threshold_75_g =
      MixedFigure{z_75 / found.sensitivity->value, z_75 / *found.sensitivity->high,
                  z_75 / *found.sensitivity->low};
  found.sd_log_sensitivity = std::exp(at[log_sd_sensitivity]);
  found.sd_log_indecision = std::exp(at[log_sd_criterion]);
  found.correlation = std::tanh(at[arctanh_correlation]);
  found.sd_bias = std::exp(at[log_sd_bias]);
  found.at_lapse = population.at_lapse;
  put_influence(found, people, population.influences);
}
}  // namespace

MixedFit fit_mixed_indecision(AnswersByPerson people) {
  MixedFit found;
  std::erase_if(people, [](const auto& person) { return trials_in(person.second) == 0; });
  const AnswersByLevel answers_of_all = together(people);
  found.n = static_cast<int>(people.size());
  found.n_trials = trials_in(answers_of_all);
  const double largest_g = largest_level_of(answers_of_all);
  found.why = found.n > 0 && largest_g == 0 ? "no trial had a difference"
                                            : too_little_chosen(answers_of_all);
  if (!found.identifiable()) return found;
  if (found.n == 1)
    put_single(found, people.begin()->second);
  else if (found.n >= least_people)
    put_population(found, people, largest_g);
  else
    found.why = fmt::format(
        "{} participants are too few to estimate how people differ, expected {} or more", found.n,
        least_people);
  return found;
}

const OwnSensitivity* MixedFit::own(const std::string& participant) const {
  const auto found = people.find(participant);
  return found == people.end() ? nullptr : &found->second;
}

Fit MixedFit::summary() const {
  Fit fit{{}, std::nullopt, n_trials, 0, why};
  if (sensitivity || indecision) fit.log_likelihood = log_likelihood;
  const auto put = [&](const char* name, const std::optional<MixedFigure>& of) {
    FittedParameter& one = fit.parameters.emplace_back(FittedParameter{name});
    if (of) one = {name, of->value, std::nullopt, of->low, of->high};
  };
  const auto alone = [](const std::optional<double>& value) {
    return value ? std::optional(MixedFigure{*value}) : std::nullopt;
  };
  put("sensitivity", sensitivity);
  put("indecision", indecision);
  put("lapse", lapse);
  put("sd_log_sensitivity", alone(sd_log_sensitivity));
  put("sd_log_indecision", alone(sd_log_indecision));
  put("correlation", alone(correlation));
  put("sd_bias", alone(sd_bias));
  put("threshold_75_g", threshold_75_g);
  return fit;
}

OwnThreshold own_threshold(const AnswersByLevel& answers, const OwnSensitivity* own) {
  if (own == nullptr) {
    const Fit fit = fit_indecision(answers, {.lapse = fixed_lapse});
    if (!fit.identifiable()) return {{}, {}, fit.why};
    const FittedParameter& threshold = fit.parameter("threshold_75_g");
    return {threshold.value, Interval{*threshold.low, *threshold.high}, ""};
  }
  std::string why = too_little_chosen(answers);
  if (why.empty()) why = why_no_threshold({own->low, own->high}, {largest_level_of(answers)});
  if (!why.empty()) return {{}, {}, why};
  return {z_75 / own->value, Interval{z_75 / *own->high, z_75 / *own->low}, ""};
}

Contrast threshold_contrast(std::span<const MixedFit* const> fits,
                            std::span<const double> weights) {
  Contrast contrast;
  std::map<std::string, double> influence;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    contrast.value += weights[i] * std::log(fits[i]->threshold_75_g->value);
    for (const auto& [participant, own] : fits[i]->influence)
      influence[participant] += weights[i] * own;
  }
  contrast.n = static_cast<int>(influence.size());
  std::vector<double> of_people;
  for (const auto& [participant, own] : influence) of_people.push_back(own);
  contrast.standard_error = jackknife_error(of_people);
  return contrast;
}

Contrast threshold_exponent(std::span<const MixedFit* const> fits,
                            std::span<const double> references_g) {
  std::vector<double> log_references;
  for (const double reference_g : references_g) log_references.push_back(std::log(reference_g));
  return threshold_contrast(fits, slope_weights(log_references));
}

}  // namespace heft
