// One figure of a study, with interval, counts and published figure. Tables, JSON, CSV, the
// dictionary and charts are made from lists of these.
#pragma once

#include <deque>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/dataset/Published.h"
#include "inference/Proportion.h"
#include "inference/Statistics.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// A quantity that is estimated, declared in the file that estimates it.
struct Measure {
  std::string_view name;     ///< snake_case, unique
  std::string_view unit;     ///< "g", "%", "s"; empty: a number
  std::string_view heading;  ///< in charts and tables
  std::string_view meaning;  ///< for the data dictionary
};

/// A coordinate of an estimate in addition to task, condition and reference, such as a level, a
/// mass or an answer.
struct Coordinate {
  std::string_view name;  ///< "level_g", "answer"
  std::string text;
  std::optional<double> value{};
};

struct StudyEstimate {
  const Measure* measure = nullptr;
  std::string task{};
  std::string condition{};
  std::optional<double> reference_g{};
  std::string participant{};  ///< empty: over all participants
  std::vector<Coordinate> by{};
  std::optional<double> value{};  ///< none: `why` has the reason
  std::optional<double> sd{};     ///< between participants, over n-1
  std::optional<double> low{}, high{};
  int n = 0;                     ///< participants
  int n_trials = 0, n_hits = 0;  ///< of a share: its denominator and numerator
  std::string_view method{};     ///< of the interval or the mean
  Censored censored = Censored::none;
  std::string why{};  ///< reason that there is no value, or that it leaves participants out
  const published::Figure* published = nullptr;  ///< null: the paper has none to compare with
  bool as_published = false;                     ///< technique, masses and task are the paper's

  void set(const std::optional<Interval>& interval) {
    if (interval) {
      low = interval->low;
      high = interval->high;
    }
  }
  /// Null: it has no coordinate of that name in `by`.
  const Coordinate* at(std::string_view name) const {
    for (const Coordinate& coordinate : by)
      if (coordinate.name == name) return &coordinate;
    return nullptr;
  }
  /// Text of a coordinate, also of task, condition, participant and reference_g; empty: it has
  /// none.
  std::string text_at(std::string_view name) const;
};

/// All estimates of a study. A deque, because a growing vector would for a moment need the memory
/// of all of them twice.
using Estimates = std::deque<StudyEstimate>;

/// A coordinate's name and its text.
using Place = std::pair<std::string_view, std::string_view>;

/// The estimates of a measure at all of these coordinates.
std::vector<const StudyEstimate*> estimates_of(const Estimates& estimates, std::string_view measure,
                                               std::initializer_list<Place> places = {});
/// The first of them; null: there is none.
const StudyEstimate* find_estimate(const Estimates& estimates, std::string_view measure,
                                   std::initializer_list<Place> places = {});

/// "> " or "< " if the value is only known to be above or below the printed one; otherwise empty.
std::string_view beyond_sign(Censored censored);

/// A coordinate that is a number.
Coordinate at(std::string_view name, double value);

/// The paper's interval: by Student's t from its SD, or exact from its number of people; none where
/// the paper gives neither.
std::optional<Interval> interval_of(const published::Figure& figure);

/// The median, with quartiles as low and high.
StudyEstimate quartiles_estimate(const Measure& measure, const std::deque<double>& values);

/// A share of trials in percent, with its interval over participants.
StudyEstimate rate_estimate(const Measure& measure, const Rate& rate);

/// One participant's share of trials in percent.
StudyEstimate own_share(const Measure& measure, const std::string& participant, const Tally& tally);

/// The mean over the participants who have a value, with Student's t interval; how many have none,
/// and why.
/// @param people the same figure of each, at least one
/// @param of_logs geometric: of logarithms; without SD
StudyEstimate mean_over_people(const std::vector<const StudyEstimate*>& people, bool of_logs);

/// mean_over_people(); for a single participant, their estimate with its interval.
StudyEstimate over_people(const std::vector<const StudyEstimate*>& people, bool of_logs);

/// Those that the paper has a figure for, each figure once for each condition.
std::vector<const StudyEstimate*> published_among(const Estimates& estimates);

}  // namespace heft
