// Comparisons with one of two answers: the share of each answer by the difference in mass, each
// participant's threshold, and how well the fitted curves describe the answers. TwoAnswerTasks.cpp
// has the tasks.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dataset/ComparisonTrials.h"
#include "analysis/dataset/StaircaseAnswers.h"
#include "analysis/measures/Section.h"
#include "inference/Fit.h"
#include "inference/checks/GoodnessOfFit.h"

namespace heft {

/// A participant's answer to a comparison.
struct TwoWayAnswer {
  double level_g = 0;
  bool counted = false;  ///< whether it is the answer whose share is shown
};

/// Fit of one participant's answers.
struct TwoAnswerFit {
  FittedParameter threshold;
  std::optional<FittedParameter> second;  ///< shown beside the threshold
  std::string why;                        ///< reason for no threshold; empty: there is one
};

/// How one of these tasks is fitted, and its measures and texts.
struct TwoAnswerTask {
  /// None unless it is an answer of this task.
  std::optional<TwoWayAnswer> (*answer_of)(const Attempt& attempt);
  TwoAnswerFit (*fit)(const AnswersByLevel& answers);
  GoodnessOfFit (*check)(const AnswersByLevel& answers);
  /// Whether random answers in adaptive staircases may pass for sensitivity.
  bool may_be_random;
  std::string method;  ///< of the fit

  const Measure &threshold, &weber_fraction, &exponent, &second;
  const Measure &deviance, &fit_p, &rejected;
  const Measure& share;  ///< of the counted answers

  std::string name;     ///< of the tables and the chart
  std::string finding;  ///< the task, at the start of a sentence
  std::string thresholds_title, thresholds_note, people_title;
  std::string n_column;
  EstimateColumn second_column;
  std::pair<std::string, std::string> second_interval;  ///< names of its columns
  std::string exponents_title, own_exponents_title;
  std::string share_title, share_caption, share_note;
  std::string counted;  ///< "chosen": the word for the counted answer
};

class TwoAnswerSection final : public Section {
 public:
  explicit TwoAnswerSection(TwoAnswerTask task) : task_(std::move(task)) {}

  void add(const SessionData& data) override;
  void put(Summary& summary) override;
  Estimates of_participants(const Summary& summary) const override;
  std::vector<std::string> findings(const Summary& summary) const override;
  std::vector<EstimateTable> tables() const override;
  std::vector<ChartSpec> charts() const override;

 private:
  /// At index 1 of each level: the number of counted answers.
  using AnswersByPerson = std::map<std::string, AnswersByLevel>;
  using Person = std::pair<Compared, std::string>;

  GoodnessOfFit goodness(const Person& person, const AnswersByLevel& answers) const;
  void put_random();
  void put_fit(Estimates& all, StudyEstimate own, const AnswersByLevel& answers,
               const std::string& why_random) const;
  void put_goodness(Estimates& all, StudyEstimate own, const GoodnessOfFit& found) const;
  StudyEstimate rejected_of(const std::vector<const StudyEstimate*>& people) const;
  void put_shares(Estimates& all, const Compared& compared, const AnswersByPerson& people) const;
  EstimateTable threshold_table() const;
  EstimateTable people_table() const;
  EstimateTable share_table() const;

  TwoAnswerTask task_;
  std::map<Compared, AnswersByPerson> people_;
  std::map<Person, std::string> not_constant_;  // and why
  StaircaseAnswers staircases_;
  std::map<Compared, std::string> random_;  // where random answers explain all of staircases
  std::map<Person, GoodnessOfFit> goodness_;
};

}  // namespace heft
