// Comparisons answered in one of two ways: how often in one of them, by the difference in mass,
// with table and chart; and how well the fitted curves describe that.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/measures/Section.h"
#include "inference/Fit.h"
#include "inference/checks/GoodnessOfFit.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {

/// Each participant's two kinds of answers by level; the second kind is counted.
using AnswersByPerson = std::map<std::string, AnswersByLevel>;

/// One participant's estimate, still without a value.
inline StudyEstimate own_estimate(const Measure& measure, const Compared& compared,
                                  const std::string& participant, const AnswersByLevel& answers) {
  StudyEstimate own{&measure, "comparison", compared.condition, compared.reference_g};
  own.participant = participant;
  own.n = 1;
  own.n_trials = static_cast<int>(trials_in(answers));
  return own;
}

/// Each participant's estimates together that are of one reference, condition and measure.
inline std::vector<std::vector<const StudyEstimate*>> together(const Estimates& own) {
  std::map<std::tuple<std::optional<double>, std::string, std::string_view>,
           std::vector<const StudyEstimate*>>
      groups;
  for (const StudyEstimate& one : own)
    groups[{one.reference_g, one.condition, one.measure->name}].push_back(&one);
  std::vector<std::vector<const StudyEstimate*>> all;
  for (auto& [key, people] : groups) all.push_back(std::move(people));
  return all;
}

struct ShareByLevel {
  const Measure& share;
  std::string name;  ///< of the chart; the table is NAME_by_level
  std::string title, caption;
  std::string hits;       ///< "chosen": the word for an answer that is counted
  std::string note = {};  ///< below the table

  void put(Estimates& all, const Compared& compared, const AnswersByPerson& people) const;
  EstimateTable table() const;
  ChartSpec chart() const;
};

inline void ShareByLevel::put(Estimates& all, const Compared& compared,
                              const AnswersByPerson& people) const {
  std::map<double, Tallies> by_level;
  for (const auto& [participant, answers] : people)
    for (const auto& [level_g, n] : answers)
      by_level[level_g][participant] = {static_cast<int>(n[1]), static_cast<int>(n[0] + n[1])};
  for (const auto& [level_g, tallies] : by_level) {
    StudyEstimate& one = all.emplace_back(rate_estimate(share, rate_of(tallies)));
    one.task = "comparison";
    one.condition = compared.condition;
    one.reference_g = compared.reference_g;
    one.by = {at("level_g", level_g)};
  }
}

inline EstimateTable ShareByLevel::table() const {
  EstimateTable table{
      name + "_by_level",
      title,
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("level_g", "difference g"), column(share, Field::n_trials, "n_trials", "trials"),
       column(share, Field::n_hits, "n_" + hits, hits),
       column(share, Field::value, hits + "_percent", "%")},
      note,
      TablePlace::csv};
  add_interval(table.columns, share, "low_percent", "high_percent", 1);
  return table;
}

inline ChartSpec ShareByLevel::chart() const {
  return {.name = name,
          .title = title,
          .caption = caption,
          .csv = name + "_by_level.csv",
          .importance = 38,
          .series = {{&share}},
          .x = "level_g",
          .panels = {"reference_g", "condition"},
          .x_label = "difference (g)",
          .y_label = "% of trials",
          .axes = "set yrange [0:100]\n"};
}

/// The goodness of each participant's fit, where the differences were constant stimuli.
class CurveChecks {
 public:
  struct Measures {
    const Measure &deviance, &p, &rejected;
  };
  CurveChecks(const Measures& measures, GoodnessOfFit (*check)(const AnswersByLevel&))
      : measures_(measures), check_(check) {}

  /// Notes how the difference of a trial was chosen.
  void add(const SessionData& data, const TrialPlan& plan);
  /// Takes a while.
  void judge(const std::map<Compared, AnswersByPerson>& people, bool checks_models);

  /// Deviance and p of one participant's fit. @param own without measure and value
  void put_own(Estimates& all, StudyEstimate own) const;
  bool is_own(const StudyEstimate& one) const {
    return one.measure == &measures_.deviance || one.measure == &measures_.p;
  }
  /// How many fits are rejected; of deviances none, because they have no mean.
  void put_rejected(Estimates& all, const std::vector<const StudyEstimate*>& people) const;

  void add_columns(std::vector<EstimateColumn>& columns) const;
  void add_own_columns(std::vector<EstimateColumn>& columns) const;

 private:
  using Person = std::pair<Compared, std::string>;

  Measures measures_;
  GoodnessOfFit (*check_)(const AnswersByLevel&);
  std::map<Person, std::string> not_constant_;  // and why
  std::map<Person, GoodnessOfFit> found_;
};

// Empty: the difference was chosen beforehand, as that of a catch trial is.
inline std::string why_not_constant(const SessionData& data, const TrialPlan& plan) {
  if (plan.staircase.empty()) return "";
  const auto found = data.staircases.find(plan.staircase);
  if (found == data.staircases.end()) return "the procedure that chose the differences is unknown";
  if (found->second.before->get_if<Constant>()) return "";
  return "an adaptive procedure chose the differences by earlier answers";
}

inline void CurveChecks::add(const SessionData& data, const TrialPlan& plan) {
  if (const std::string why = why_not_constant(data, plan); !why.empty())
    not_constant_[{{*plan.reference_g, plan.condition}, data.participant()}] = why;
}

inline void CurveChecks::judge(const std::map<Compared, AnswersByPerson>& all, bool checks_models) {
  for (const auto& [compared, people] : all)
    for (const auto& [participant, answers] : people) {
      const auto why = not_constant_.find({compared, participant});
      found_[{compared, participant}] = !checks_models ? GoodnessOfFit{.why = "not checked"}
                                        : why != not_constant_.end()
                                            ? GoodnessOfFit{.why = why->second}
                                            : check_(answers);
    }
}

inline void CurveChecks::put_own(Estimates& all, StudyEstimate own) const {
  const GoodnessOfFit& found = found_.at({{*own.reference_g, own.condition}, own.participant});
  own.why = found.why;
  for (const auto& [measure, value] :
       {std::pair(&measures_.deviance, found.deviance), {&measures_.p, found.p}}) {
    own.measure = measure;
    own.value = value;
    all.push_back(own);
  }
}

inline void CurveChecks::put_rejected(Estimates& all,
                                      const std::vector<const StudyEstimate*>& people) const {
  if (people.front()->measure != &measures_.p) return;
  StudyEstimate count = *people.front();
  count.measure = &measures_.rejected;
  count.participant.clear();
  count.value.reset();
  count.n = count.n_trials = 0;
  for (const StudyEstimate* own : people) {
    count.n_trials += own->n_trials;
    if (!own->value) continue;
    count.n += 1;
    count.value = count.value.value_or(0) + (*own->value < 0.05 ? 1 : 0);
  }
  if (count.n > 0) count.why.clear();
  all.push_back(count);
}

inline void CurveChecks::add_columns(std::vector<EstimateColumn>& columns) const {
  columns.push_back(column(measures_.rejected, Field::n, "n_fits_judged", "fits judged"));
  columns.push_back(column(measures_.rejected, Field::value, "n_fits_rejected", "rejected", 0));
  columns.push_back(column(measures_.rejected, Field::why, "fits_why", "not judged: why"));
}

inline void CurveChecks::add_own_columns(std::vector<EstimateColumn>& columns) const {
  columns.push_back(column(measures_.deviance, Field::value, "deviance", "deviance", 2));
  columns.push_back(column(measures_.p, Field::value, "fit_p", "p of the fit", 3));
  columns.push_back(column(measures_.p, Field::why, "fit_why", "not judged: why"));
}

}  // namespace heft
