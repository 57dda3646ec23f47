// What the report's figures show point by point: of people, levels and masses.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/ComparisonTrials.h"
#include "inference/Proportion.h"
#include "tasks/Tasks.h"

namespace heft {

/// Comparisons at one reference in one condition whose differences lie next to each other. Catch
/// trials are among those at 0.
struct ChoiceBin {
  Compared compared;
  double mean_level_g = 0;
  int n_trials = 0;
  Rate right, wrong, none;  ///< at 0 either choice is half right, half wrong, and not counted there
  /// By participant, of those with trials here; empty: there are more than can be drawn apart.
  std::map<std::string, double> right_percent_of{};
};

/// More participants than this have no line of their own.
inline constexpr std::size_t most_lines = 60;

/// One participant's percentages of right sortings, of all completed ones; none without any.
struct PersonSorting {
  std::string participant;
  std::optional<double> c1_percent, c2_percent;
};

/// How often one participant saw a difference where there was one, and where there was none.
struct PersonDetection {
  std::string participant;
  double hits_percent = 0, false_alarms_percent = 0;
  int n_trials = 0, n_catch = 0;
};

/// Median and quartiles of something measured, of what lies in one band.
struct Quartiles {
  std::string group;  ///< "200 g", "C2"...
  double at = 0;      ///< mean difference, mass or trial
  int n = 0;
  double median = 0, lower_quartile = 0, upper_quartile = 0;
};

/// Labels given to the cubes of three, from the lightest on, by condition: [cube][label].
using LabelMatrix = std::array<std::array<int, 3>, 3>;

struct Points {
  std::vector<ChoiceBin> choices;
  std::vector<PersonSorting> sorting;
  std::vector<PersonDetection> detection;  ///< of those with catch trials
  std::vector<Quartiles> times_by_level;   ///< seconds, comparisons by reference
  std::vector<Quartiles> times_by_trial;   ///< seconds, by task, ten bins over a session's trials
  std::vector<Quartiles> lag_by_mass;      ///< mm, largest of a trial, by condition
  std::map<std::string, LabelMatrix> labels;
};

class PointsFold {
 public:
  void add(const SessionData& data);
  /// @param trials of the same sessions
  Points result(const ComparisonTrials& trials) const;

 private:
  void add_sorting(const std::string& participant, const Attempt& attempt);
  void add_times(const SessionData& data);
  void add_lags(const Attempt& attempt);

  std::map<std::string, std::map<std::string, Tally>> sortings_;  // participant, condition
  std::map<std::string, LabelMatrix> labels_;                     // condition
  std::map<Task, std::map<int, std::deque<double>>, InTaskOrder> times_s_;  // tenth of the trials
  std::map<std::string, std::map<double, std::deque<double>>> lag_mm_;      // condition, mass
};

Points points_of(std::span<const SessionData> sessions);

}  // namespace heft
