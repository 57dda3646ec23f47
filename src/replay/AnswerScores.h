// How well models predict the answers that people gave: scores of each model's answers to the same
// trials, over people. Input is, for each trial, its answer and the answers that each model drew.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/TrialPlan.h"
#include "inference/Statistics.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

/// The answers of one model to one trial in repeated draws.
struct AnswerDraws {
  int n = 0;
  std::map<std::string, int> n_by_answer;
  /// For tasks with labels: by slot, "none" for a cube without one.
  std::vector<std::map<std::string, int>> n_by_label;

  void add(const std::string& answer, const std::vector<std::string>& labels);
  int n_of(const std::string& answer) const;
};

/// A completed trial with the logged answer and those of each model, in the words of
/// TaskTrial::answer(); where cubes get labels, the labels from the left.
struct JudgedTrial {
  std::string person;
  std::int64_t session_id = 0;
  int trial_number = 0;
  Task task;
  std::string condition;  ///< technique
  std::optional<double> reference_g, level_g;
  bool has_difference = true;  ///< between the cubes' masses
  int n_answers = 0;           ///< number of answers that the trial offers
  bool detects = false;        ///< whether answers state if the cubes differ
  std::string answer;
  std::vector<std::string> labels;
  std::vector<AnswerDraws> models;
};

/// Probability of an answer, from draws: (n of it + 1/2) / (n of draws + n of answers / 2), which
/// is never 0 (Krichevsky & Trofimov 1981).
double probability_of(const AnswerDraws& draws, const std::string& answer, int n_answers);

// Scores of one trial and model. Log scores are natural logarithms of probabilities: 0 is a certain
// prediction, -log(n_answers) is chance.

double log_score(const JudgedTrial& trial, std::size_t model);
/// Expected log score if the model itself had answered: each draw scored by the others. No model
/// scores better on answers that are its own.
double log_score_of_own(const JudgedTrial& trial, std::size_t model);
/// Probability that a draw is the logged answer.
double agreement(const JudgedTrial& trial, std::size_t model);
/// Probability that two draws are equal.
double agreement_with_own(const JudgedTrial& trial, std::size_t model);

/// A mean over people, each of whom counts once, with Student's interval.
struct MeanOverPeople {
  double value = 0;
  std::optional<Interval> interval;  ///< none for one person
};

/// Sensitivity and criterion of "different" answers, all people together; standard errors by the
/// jackknife over people with Student's quantile (Efron & Stein 1981).
struct DetectionOverPeople {
  double d_prime = 0, criterion = 0;
  std::optional<Interval> d_prime_interval, criterion_interval;  ///< none for one person
};

/// Logged answer, model's answer -> number of trials, by the model's probabilities.
using Confusion = std::map<std::pair<std::string, std::string>, double>;

struct ModelScores {
  MeanOverPeople log_score, own_log_score, agreement, own_agreement;
  /// Log score minus the first model's, paired by person; 0 for the first model.
  MeanOverPeople difference;
  int n_people_better = 0;  ///< people with a positive difference
  /// Log score of a trial's own answer minus the mean log score that the answers to the person's
  /// other trials of the same task, condition and reference would have in this trial. 0: the frames
  /// do not help the model (chance). None: no person has two such trials.
  std::optional<MeanOverPeople> from_frames;
  std::optional<DetectionOverPeople> detection;
  Confusion answers, labels;
};

/// Scores of the trials of one group.
struct GroupScores {
  Task task;  ///< empty: all tasks together
  std::string condition;
  std::optional<double> reference_g, level_g;
  int n_trials = 0, n_people = 0;
  MeanOverPeople chance;  ///< log score of equally likely answers
  /// Log score of a model that knows only how often each answer is given to the other trials of the
  /// same task, condition and reference. A model that looks at the cubes should score better.
  MeanOverPeople shares;
  std::optional<DetectionOverPeople> person;  ///< of the logged answers
  std::vector<ModelScores> models;
};

/// What trials must have in common.
enum class ScoreGroups { all, references, levels };

/// By task, technique and reference, or also by level. `person` and `detection` of a level compare
/// it with the trials without difference of its reference. Answers and levels have detection only
/// in tasks whose answer states whether the cubes differ.
std::vector<GroupScores> scores_of(const std::vector<JudgedTrial>& trials, std::size_t n_models,
                                   ScoreGroups groups);

}  // namespace heft
