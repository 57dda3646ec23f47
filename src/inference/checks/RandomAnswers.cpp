#include "inference/checks/RandomAnswers.h"

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
enum Answer : std::size_t { negative, positive };

// Answers at levels from their mean, in units of the largest distance from it.
struct CenteredAnswers {
  explicit CenteredAnswers(const AnswersByLevel& answers) {
    const double n_trials = trials_in(answers);
    double mean = 0, furthest = 0;
    for (const auto& [level, n] : answers) mean += level * (n[negative] + n[positive]) / n_trials;
    for (const auto& [level, n] : answers) furthest = std::max(furthest, std::abs(level - mean));
    for (const auto& [level, n] : answers)
      levels.push_back({(level - mean) / furthest, n[negative], n[positive]});
  }
  struct Level {
    double x, n_negative, n_positive;
  };
  std::vector<Level> levels;
};

// log(1 + e^z)
double log_odds_sum(double z) {
  return z > 0 ? z + std::log1p(std::exp(-z)) : std::log1p(std::exp(z));
}

double log_likelihood(const CenteredAnswers& answers, double middle, double slope) {
  double sum = 0;
  for (const auto& [x, n_negative, n_positive] : answers.levels) {
    const double z = middle + slope * x;
    sum -= n_positive * log_odds_sum(-z) + n_negative * log_odds_sum(z);
  }
  return sum;
}

struct NewtonStep {
  double middle = 0, slope = 0;
  bool exists = true;  // false: the likelihood is flat
};

NewtonStep newton_step(const CenteredAnswers& answers, double middle, double slope) {
  double g0 = 0, g1 = 0, h00 = 0, h01 = 0, h11 = 0;
  for (const auto& [x, n_negative, n_positive] : answers.levels) {
    const double share = 1 / (1 + std::exp(-(middle + slope * x)));
    const double n = n_negative + n_positive, weight = n * share * (1 - share);
    g0 += n_positive - n * share;
    g1 += (n_positive - n * share) * x;
    h00 += weight;
    h01 += weight * x;
    h11 += weight * x * x;
  }
  const double determinant = h00 * h11 - h01 * h01;
  if (determinant < 1e-12) return {0, 0, false};
  return {(h11 * g0 - h01 * g1) / determinant, (h00 * g1 - h01 * g0) / determinant};
}

AnswersByLevel with_random_answers(const AnsweredLevels& person, double share,
                                   RandomStream& stream) {
  AnswersByLevel answers;
  const auto answer = [&](double level) {
    const bool is_positive = stream.coin(share);
    answers[level][is_positive ? positive : negative] += 1;
    return is_positive;
  };
  if (person.staircases.empty())
    for (const auto& [level, n] : person.answers)
      for (double i = 0; i < n[negative] + n[positive]; ++i) answer(level);
  for (const auto& [before, n_trials] : person.staircases) {
    Procedure procedure = *before;
    while (!procedure.finished() && (!n_trials || procedure.n_trials() < *n_trials)) {
      const double level = procedure.next_level(stream);
      procedure.respond({answer(level), {}}, level);
    }
  }
  return answers;
}
}  // namespace

double gain_of_levels(const AnswersByLevel& answers) {
  constexpr int most_steps = 30;
  constexpr double shortest_step = 1e-4;  // of a Newton step
  const auto n = totals(answers);
  if (n[negative] == 0 || n[positive] == 0 || answers.size() < 2) return 0;
  const CenteredAnswers centered(answers);
  double middle = std::log(n[positive] / n[negative]), slope = 0;
  const double flat = log_likelihood(centered, middle, slope);
  double best = flat;
  for (int i = 0; i < most_steps; ++i) {
    const NewtonStep step = newton_step(centered, middle, slope);
    if (!step.exists) break;
    double part = 1, next = 0;
    for (; part > shortest_step; part /= 2) {
      next = log_likelihood(centered, middle + part * step.middle, slope + part * step.slope);
      if (next >= best) break;
    }
    if (!(next > best)) break;
    middle += part * step.middle;
    slope += part * step.slope;
    const bool is_last = next - best < 1e-6;
    best = next;
    if (is_last) break;
  }
  return slope > 0 ? 2 * (best - flat) : 0;
}

namespace {
double share_of(const std::array<double, 3>& n) {
  return n[positive] / (n[negative] + n[positive]);
}

// Of studies in which everyone gives the positive answer as often as they did, or all equally
// often.
double p_of_random_answers(std::span<const AnsweredLevels> people,
                           std::optional<double> share_of_all, std::uint64_t seed) {
  constexpr int n_studies = 399;
  double observed = 0;
  std::vector<double> simulated(n_studies);
  for (std::size_t i = 0; i < people.size(); ++i) {
    observed += gain_of_levels(people[i].answers);
    const double share = share_of_all.value_or(share_of(totals(people[i].answers)));
    RandomStream stream(seed, "random answers of person " + std::to_string(i));
    for (double& sum : simulated)
      sum += gain_of_levels(with_random_answers(people[i], share, stream));
  }
  const auto n_as_large =
      std::ranges::count_if(simulated, [&](double sum) { return sum >= observed; });
  return static_cast<double>(1 + n_as_large) / (1 + n_studies);
}
}  // namespace

// Shares of few trials are inexact, and random answers gain the most at shares near a half: with
// the shares of each alone, 12 % of studies of 8 fair coins have p < .05.
double p_of_random_answers(std::span<const AnsweredLevels> people, std::uint64_t seed) {
  std::array<double, 3> n{};
  for (const AnsweredLevels& person : people)
    for (const Answer answer : {negative, positive}) n[answer] += totals(person.answers)[answer];
  return std::max(p_of_random_answers(people, std::nullopt, seed),
                  p_of_random_answers(people, share_of(n), seed));
}

}  // namespace heft
