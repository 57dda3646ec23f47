// The data-quality summary: anticipatory responses, void attempts, lost tracking, logged incidents,
// and whether losses depend on the level shown.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "tasks/Task.h"

namespace heft {

/// Faster answers are anticipatory, whatever the session allows.
inline constexpr double fastest_answer_s = 0.3;

struct DataQualityRow {
  std::string what;
  int n = 0;
  std::optional<int> of;  ///< number of cases among which n are counted
  std::string meaning;
};

/// Losses by task, condition and level; losses that depend on them bias the results.
struct LossRow {
  Task task;
  std::string condition;
  std::string difference;  ///< comparisons: "0 g", "1-100 g"...; otherwise empty
  int n_attempts = 0, n_completed = 0, n_void = 0;
  int n_lost = 0;          ///< attempts with the effector out of view
  double lost_s = 0;       ///< in all
  int n_anticipatory = 0;  ///< answers too early (as the setup has it), too fast or without contact
};

struct ResetRow {
  std::string mass;  ///< "15 g", "16-50 g"...
  int n_cubes = 0;   ///< shown in a completed trial
  int n_reset = 0;   ///< that were put back to their start at least once
};

struct Quality {
  std::vector<DataQualityRow> counted;
  std::vector<LossRow> losses;
  std::vector<ResetRow> resets;
};

/// Whether a completed trial's answer is anticipatory: earlier than its configuration allows,
/// faster than fastest_answer_s, or without contact.
bool is_anticipatory(const SessionData& data, const Attempt& attempt);

class QualityCollector {
 public:
  void add(const SessionData& data);
  Quality result() const;

  struct Sums {
    int n_sessions = 0, n_unfinished = 0;
    int n_completed = 0, n_early = 0, n_fast = 0, n_untouched = 0;
    std::set<double> least_answers_s;
    EventCounts events;
    PictureCounts pictures;
  };

 private:
  Sums sums_;
  std::map<std::tuple<Task, std::string, std::size_t>, LossRow, InTaskOrder>
      losses_;                              // by band of differences
  std::map<std::size_t, ResetRow> resets_;  // by band of masses
};

/// One value of a column of the log's table `setup`.
struct SetupValue {
  std::string what, unit, value, meaning;
  int n_sessions = 0, n_attempts = 0;  ///< that ran with it
};

/// Every recorded value, in the order of the columns.
class SetupsCollector {
 public:
  void add(const SessionData& data);
  std::vector<SetupValue> result() const;

 private:
  struct Counted {
    int n_sessions = 0, n_attempts = 0;
  };
  std::map<std::pair<std::size_t, std::string>, Counted> values_;  // by column and value
};

/// A note, deviation, unblinding or a check that was not passed, as the log has it.
struct Incident {
  std::int64_t session_id = 0;
  std::string participant;
  Noted noted;
};

/// In order.
class IncidentsCollector {
 public:
  void add(const SessionData& data);
  std::vector<Incident> result() const { return incidents_; }

 private:
  std::vector<Incident> incidents_;
};

}  // namespace heft
