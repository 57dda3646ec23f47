#include "replay/AnswerScores.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "tasks/Task.h"

namespace heft {

namespace {
using Trials = std::vector<const JudgedTrial*>;
using OfTrial = std::function<double(const JudgedTrial&)>;

std::map<std::string, std::vector<double>> by_person(const Trials& trials, const OfTrial& value) {
  std::map<std::string, std::vector<double>> values;
  for (const JudgedTrial* trial : trials) values[trial->person].push_back(value(*trial));
  return values;
}

std::vector<double> means_of_people(const Trials& trials, const OfTrial& value) {
  std::vector<double> means;
  for (const auto& [person, values] : by_person(trials, value)) means.push_back(*mean(values));
  return means;
}

MeanOverPeople mean_over_people(const Trials& trials, const OfTrial& value) {
  const std::vector<double> means = means_of_people(trials, value);
  return {*mean(means), student_t_interval(means)};
}

// Answers to one trial: the logged one, or all draws of a model.
struct DifferentAnswers {
  int n_different = 0, n = 0;
};

// "Different" answers of one person.
struct Answered {
  DetectionCounts counts;

  void add(bool has_difference, const DifferentAnswers& answers) {
    (has_difference ? counts.n_signal : counts.n_noise) += answers.n;
    (has_difference ? counts.n_hits : counts.n_false_alarms) += answers.n_different;
  }
  void add(const Answered& other, double sign = 1) {
    counts.n_signal += sign * other.counts.n_signal;
    counts.n_hits += sign * other.counts.n_hits;
    counts.n_noise += sign * other.counts.n_noise;
    counts.n_false_alarms += sign * other.counts.n_false_alarms;
  }
};

std::optional<Interval> jackknife_interval(double value, const std::vector<double>& without_one) {
  const auto n = static_cast<double>(without_one.size());
  const double center = *mean(without_one);
  double sum_squared = 0;
  for (const double one : without_one) sum_squared += (one - center) * (one - center);
  const double reach = student_t_quantile(n - 1) * std::sqrt((n - 1) / n * sum_squared);
  return Interval{value - reach, value + reach};
}

std::optional<DetectionOverPeople> detection_of(
    const Trials& trials, const std::function<DifferentAnswers(const JudgedTrial&)>& answers_to) {
  std::map<std::string, Answered> people;
  Answered all;
  for (const JudgedTrial* trial : trials) {
    if (!trial->detects) return std::nullopt;
    people[trial->person].add(trial->has_difference, answers_to(*trial));
  }
  for (const auto& [person, answered] : people) all.add(answered);
  const auto found = detection(all.counts);
  if (!found) return std::nullopt;
  DetectionOverPeople over{found->d_prime, found->criterion, {}, {}};
  std::vector<double> d_primes, criteria;
  for (const auto& [person, answered] : people) {
    Answered others = all;
    others.add(answered, -1);
    const auto without = detection(others.counts);
    if (!without) return over;
    d_primes.push_back(without->d_prime);
    criteria.push_back(without->criterion);
  }
  if (people.size() < 2) return over;
  over.d_prime_interval = jackknife_interval(over.d_prime, d_primes);
  over.criterion_interval = jackknife_interval(over.criterion, criteria);
  return over;
}

void add_to(Confusion& confusion, const std::string& logged,
            const std::map<std::string, int>& n_by_answer, int n_draws) {
  for (const auto& [answer, n] : n_by_answer)
    confusion[{logged, answer}] += static_cast<double>(n) / n_draws;
}

ModelScores scores_of(const Trials& trials, const Trials& with_catches, std::size_t model) {
  const auto over = [&](double (*score)(const JudgedTrial&, std::size_t)) {
    return mean_over_people(trials, [&](const JudgedTrial& trial) { return score(trial, model); });
  };
  ModelScores scores;
  scores.log_score = over(log_score);
  scores.own_log_score = over(log_score_of_own);
  scores.agreement = over(agreement);
  scores.own_agreement = over(agreement_with_own);
  const auto difference = [model](const JudgedTrial& trial) {
    return log_score(trial, model) - log_score(trial, 0);
  };
  scores.difference = mean_over_people(trials, difference);
  scores.n_people_better = static_cast<int>(
      std::ranges::count_if(means_of_people(trials, difference), [](double d) { return d > 0; }));
  // All draws are counted: with the correction of rates, the few catch trials would be pulled to
  // 1/2, and a model that does not look would have a d' below 0.
  scores.detection = detection_of(with_catches, [model](const JudgedTrial& trial) {
    const AnswerDraws& draws = trial.models[model];
    return DifferentAnswers{draws.n - draws.n_of("none"), draws.n};
  });
  for (const JudgedTrial* trial : trials) {
    const AnswerDraws& draws = trial->models[model];
    if (trial->labels.empty()) add_to(scores.answers, trial->answer, draws.n_by_answer, draws.n);
    for (std::size_t i = 0; i < trial->labels.size(); ++i)
      add_to(scores.labels, trial->labels[i], draws.n_by_label[i], draws.n);
  }
  return scores;
}

using GroupKey = std::tuple<Task, std::string, std::optional<double>, std::optional<double>>;

GroupKey key_of(const JudgedTrial& trial, ScoreGroups groups) {
  if (groups == ScoreGroups::all) return {};
  return {trial.task, trial.condition, trial.reference_g,
          groups == ScoreGroups::levels ? trial.level_g : std::nullopt};
}

// The logged answers to a trial and to the other trials of its reference.
class AnswerShares {
 public:
  explicit AnswerShares(const std::vector<JudgedTrial>& trials) {
    for (const JudgedTrial& trial : trials) {
      const GroupKey key = key_of(trial, ScoreGroups::references);
      by_group_[key].add(trial.answer, {});
      by_person_[{trial.person, key}].add(trial.answer, {});
    }
  }
  double log_score(const JudgedTrial& trial) const {
    const AnswerDraws& all = by_group_.at(key_of(trial, ScoreGroups::references));
    return std::log((all.n_of(trial.answer) - 0.5) / (all.n - 1 + 0.5 * trial.n_answers));
  }
  std::optional<MeanOverPeople> from_frames(const Trials& trials, std::size_t model) const {
    Trials comparable;
    for (const JudgedTrial* trial : trials)
      if (of_person(*trial).n > 1) comparable.push_back(trial);
    if (comparable.empty()) return std::nullopt;
    return mean_over_people(comparable, [&](const JudgedTrial& trial) {
      return heft::log_score(trial, model) - score_of_others(trial, model);
    });
  }

 private:
  const AnswerDraws& of_person(const JudgedTrial& trial) const {
    return by_person_.at({trial.person, key_of(trial, ScoreGroups::references)});
  }
  // Mean log score that the answers to the person's other trials would have in this trial.
  double score_of_others(const JudgedTrial& trial, std::size_t model) const {
    const AnswerDraws& answers = of_person(trial);
    double sum = -heft::log_score(trial, model);
    for (const auto& [answer, n] : answers.n_by_answer)
      sum += n * std::log(probability_of(trial.models[model], answer, trial.n_answers));
    return sum / (answers.n - 1);
  }

  std::map<GroupKey, AnswerDraws> by_group_;
  std::map<std::pair<std::string, GroupKey>, AnswerDraws> by_person_;
};

// The level's own trials, and those of its reference without a difference.
Trials with_catches(const std::vector<JudgedTrial>& trials, const Trials& of_level) {
  Trials all = of_level;
  const JudgedTrial& one = *of_level.front();
  if (!one.has_difference) return all;
  for (const JudgedTrial& trial : trials)
    if (!trial.has_difference &&
        key_of(trial, ScoreGroups::references) == key_of(one, ScoreGroups::references))
      all.push_back(&trial);
  return all;
}

}  // namespace

void AnswerDraws::add(const std::string& answer, const std::vector<std::string>& labels) {
  ++n;
  ++n_by_answer[answer];
  n_by_label.resize(std::max(n_by_label.size(), labels.size()));
  for (std::size_t i = 0; i < labels.size(); ++i) ++n_by_label[i][labels[i]];
}

int AnswerDraws::n_of(const std::string& answer) const {
  const auto found = n_by_answer.find(answer);
  return found == n_by_answer.end() ? 0 : found->second;
}

double probability_of(const AnswerDraws& draws, const std::string& answer, int n_answers) {
  return (draws.n_of(answer) + 0.5) / (draws.n + 0.5 * n_answers);
}

double log_score(const JudgedTrial& trial, std::size_t model) {
  return std::log(probability_of(trial.models[model], trial.answer, trial.n_answers));
}

double log_score_of_own(const JudgedTrial& trial, std::size_t model) {
  const AnswerDraws& draws = trial.models[model];
  double sum = 0;
  for (const auto& [answer, n] : draws.n_by_answer)
    sum += n * std::log((n - 0.5) / (draws.n - 1 + 0.5 * trial.n_answers));
  return sum / draws.n;
}

double agreement(const JudgedTrial& trial, std::size_t model) {
  const AnswerDraws& draws = trial.models[model];
  return static_cast<double>(draws.n_of(trial.answer)) / draws.n;
}

double agreement_with_own(const JudgedTrial& trial, std::size_t model) {
  const AnswerDraws& draws = trial.models[model];
  double n_pairs = 0;
  for (const auto& [answer, n] : draws.n_by_answer) n_pairs += static_cast<double>(n) * (n - 1);
  return n_pairs / (static_cast<double>(draws.n) * (draws.n - 1));
}

std::vector<GroupScores> scores_of(const std::vector<JudgedTrial>& trials, std::size_t n_models,
                                   ScoreGroups groups) {
  std::map<GroupKey, Trials, InTaskOrder> by_key;
  for (const JudgedTrial& trial : trials) by_key[key_of(trial, groups)].push_back(&trial);
  const AnswerShares shares(trials);
  std::vector<GroupScores> all;
  for (const auto& [key, of_key] : by_key) {
    GroupScores group;
    std::tie(group.task, group.condition, group.reference_g, group.level_g) = key;
    const Trials compared = groups == ScoreGroups::levels ? with_catches(trials, of_key) : of_key;
    group.n_trials = static_cast<int>(of_key.size());
    group.chance = mean_over_people(
        of_key, [](const JudgedTrial& trial) { return -std::log(trial.n_answers); });
    group.shares =
        mean_over_people(of_key, [&](const JudgedTrial& trial) { return shares.log_score(trial); });
    group.n_people = static_cast<int>(by_person(of_key, [](const auto&) { return 0.0; }).size());
    group.person = detection_of(compared, [](const JudgedTrial& trial) {
      return DifferentAnswers{trial.answer == "none" ? 0 : 1, 1};
    });
    for (std::size_t model = 0; model < n_models; ++model) {
      group.models.push_back(scores_of(of_key, compared, model));
      group.models.back().from_frames = shares.from_frames(of_key, model);
    }
    all.push_back(std::move(group));
  }
  return all;
}

}  // namespace heft
