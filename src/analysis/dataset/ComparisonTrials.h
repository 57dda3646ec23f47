// Completed comparisons, reduced to what the figures need, because those of all participants stay
// in memory.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Jnd.h"
#include "inference/Fit.h"
#include "inference/checks/PredictiveCheck.h"

namespace heft {

enum class SideChosen : std::uint8_t { left, none, right };

struct ComparedTrial {
  double level_g = 0;                ///< comparison - reference
  std::optional<double> response_s;  ///< see response_time_s
  std::uint32_t person = 0;          ///< index into ComparisonTrials::participants
  SideChosen side = SideChosen::none;
  bool difference : 1 = false;  ///< whether a cube was chosen
  bool is_catch : 1 = false;
  bool reference_on_right : 1 = false;
  std::optional<bool> correct;  ///< whether the heavier cube was chosen; none: undefined

  double right_minus_left_g() const { return reference_on_right ? -level_g : level_g; }
};

/// Comparisons with an answer and a level, without practice.
class ComparisonTrials {
 public:
  void add(const SessionData& data);

  /// In the order of sessions and trials.
  const std::map<Compared, std::deque<ComparedTrial>>& by_compared() const { return trials_; }
  const std::vector<std::string>& participants() const { return participants_; }
  /// Whether all were in the paper's technique and at one of its references.
  bool as_published(const Compared& compared) const;
  const std::string& participant(const ComparedTrial& trial) const {
    return participants_[trial.person];
  }

 private:
  std::uint32_t place_of(const std::string& participant);

  std::map<Compared, std::deque<ComparedTrial>> trials_;
  std::map<Compared, published::Comparable> comparable_;
  std::vector<std::string> participants_;
  std::map<std::string, std::uint32_t> places_;
};

/// Each participant's answers at one reference, catch trials too: left, none, right by the mass on
/// the right minus that on the left.
std::map<std::string, AnswersByLevel> answers_by_side(const ComparisonTrials& trials,
                                                      const Compared& compared);

using ComparedTrials = std::vector<const ComparedTrial*>;
ComparedTrials pointers_to(const std::deque<ComparedTrial>& trials);

/// Trials in bins of neighboring differences, lowest first, about equally many in each; those of
/// equal differences together, and those at 0, catch trials included, in a separate bin.
std::vector<ComparedTrials> binned(ComparedTrials trials);
double mean_level_g(const ComparedTrials& bin);

/// The choices of each staircase, with the procedure before its first trial: input of predictive
/// checks.
class StaircaseRuns {
 public:
  void add(const SessionData& data);

  /// The runs of each participant, moved out of this object; empty if a staircase's procedure is
  /// unknown.
  std::vector<PersonRuns> take(const Compared& compared);

 private:
  std::map<Compared, std::map<std::string, PersonRuns>> people_;
  std::set<Compared> unknown_;
};

}  // namespace heft
