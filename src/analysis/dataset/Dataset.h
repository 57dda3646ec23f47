// The part of a log that the analysis reads, with each attempt's rows joined. Everything after this
// is a pure function of a Dataset.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "analysis/dataset/Published.h"
#include "experiment/Rows.h"
#include "inference/checks/PredictiveCheck.h"
#include "protocol/study/AnalysisPlan.h"
#include "record/reader/LogReader.h"
#include "tasks/blocks/Answers.h"

namespace heft {

/// One attempt at a trial with all that was logged of it.
struct Attempt {
  TrialRow trial;
  std::vector<CubeRow> cubes;      ///< by slot
  std::vector<AnswerRow> answers;  ///< in order
  bool is_reversal = false;
  /// Largest turn of the clone against the hand while it touched a cube, by slot; only where frames
  /// were kept.
  std::map<int, double> clone_yaw_deg{};
  /// What a comparison could be answered by.
  ComparisonAnswers answers_offered = ComparisonAnswers::heavier_or_none;

  bool completed() const { return trial.status == TrialStatus::completed; }
  /// A completed comparison with an answer and a level: of three answers, or others.
  bool is_usable_comparison(ComparisonAnswers answered = ComparisonAnswers::heavier_or_none) const {
    return has_comparison() && answers_offered == answered;
  }
  bool has_comparison() const;
  std::vector<double> masses_g() const;  ///< by slot
  /// Whether its cubes have these masses, given from light to heavy, and the protocol's friction.
  bool shows(std::span<const double> masses) const;
};

/// validated - shown - paused - lost, in seconds; none where the trial was not shown or validated.
std::optional<double> response_time_s(const TrialRow& trial);

/// Camera pictures of a session with a participant.
struct PictureCounts {
  int shown = 0, dropped = 0, late = 0;
  int doubled = 0;  ///< with a second print of a tag in view

  PictureCounts& operator+=(const PictureCounts& more) {
    shown += more.shown;
    dropped += more.dropped;
    late += more.late;
    doubled += more.doubled;
    return *this;
  }
};

/// How well the effector of a session was tracked.
struct TrackingCounts {
  int n_lost = 0;                      ///< tracking losses in trials
  double lost_s = 0, answering_s = 0;  ///< out of sight; of what time from shown to validated
  FrameCounts frames;                  ///< none where frames were not kept
};

/// Incidents of a session.
struct EventCounts {
  int notes = 0, deviations = 0, checks_failed = 0, checks_warned = 0, unblindings = 0;
  int effector_lost = 0;
  std::optional<bool> consented{};  ///< none: it was not asked
};

/// A note, deviation, unblinding or a check that was not passed.
struct Noted {
  double t_s = 0;
  EventKind kind = event_kind<Note>;
  std::string text;
};

struct SessionData {
  SessionRow session;
  std::string lab{};              ///< see lab_names(); of a single log empty
  std::vector<Attempt> attempts;  ///< without practice
  int n_practice = 0;             ///< attempts at practice trials
  std::vector<EstimateRow> estimates;
  PictureCounts pictures;
  EventCounts events;
  std::vector<Noted> noted{};       ///< in order
  FrameCounts frames;               ///< none where frames were not kept
  std::vector<LoggedSetup> setups;  ///< configurations, in order
  /// Staircases of the protocol that estimate no JND, such as constant stimuli.
  std::set<std::string> without_jnd{};
  std::optional<AnalysisPlan> plan{};  ///< what its protocol declares to test; none: nothing
  ExclusionRules exclusion{};
  /// Its protocol's staircases by name, without choices.
  std::map<std::string, StaircaseRun> staircases{};
  /// Those of its conditions that the paper measured, by law and parameters.
  std::map<std::string, published::Condition> published_conditions{};
  /// What its judgments ask, and what the answers respond to procedures, by block.
  std::map<std::string, JudgmentOffer> judgments{};

  /// A model answered at least one of its trials; where there is none, was to answer.
  bool simulated() const { return model().has_value(); }
  /// That model.
  std::optional<std::string> model() const;
  /// Identity for counting; simulated responders with one name but different models are distinct.
  std::string participant() const;
  /// A trial's configuration; null: the log has none.
  const SessionConfig* setup_of(const Attempt& attempt) const;
  TrackingCounts tracking() const;
  /// The paper's condition that a trial was in; none: another technique.
  std::optional<published::Condition> published_condition(const std::string& condition) const;
  bool finished() const { return session.state == SessionState::finished; }
};

/// The sum of a session's `camera` events.
PictureCounts count_pictures(const std::vector<LoggedEvent>& events);

/// Those that are reported in words.
std::vector<Noted> noted_in(const std::vector<LoggedEvent>& events);

/// The events of a session that EventCounts counts.
EventCounts count_events(const std::vector<LoggedEvent>& events);

/// The rows of one session as the log holds them.
struct SessionRows {
  std::vector<TrialRow> trials;
  std::vector<CubeRow> cubes;
  std::vector<AnswerRow> answers;
  std::vector<ReversalRow> reversals;
  std::vector<EstimateRow> estimates;
};

/// Joins each attempt's rows. Rows of an attempt that has no trial row are left out.
SessionData join_rows(const SessionRow& session, const SessionRows& rows);

struct Dataset {
  std::string database;  ///< the logs' file names, as given
  std::vector<SessionData> sessions;
};

/// The sessions of one or several logs, read one by one: of a thousand no more than one is in
/// memory.
class LoggedSessions {
 public:
  /// @param session_ids which, of a single log; empty: all
  /// @throws Error when a file can't be read, is given twice or has no such session; (usage) when
  ///   sessions of several logs are named
  LoggedSessions(const std::vector<std::string>& databases,
                 const std::vector<std::int64_t>& session_ids);

  /// The logs' files, as given.
  std::string database() const;
  /// May be called again, and gives the same. Of several logs participants have person_name(), and
  /// each log is a lab's.
  void each(const std::function<void(const SessionData&)>& use) const;
  /// Sessions without data, because they were withdrawn.
  int n_withdrawn() const { return n_withdrawn_; }
  /// By name, how many sessions have each.
  const std::map<std::string, int>& purposes() const { return purposes_; }

 private:
  struct OneLog {
    std::string name, lab;
    LogReader reader;
    std::vector<std::int64_t> session_ids;
  };

  std::vector<OneLog> logs_;
  std::map<std::string, int> purposes_;
  int n_withdrawn_ = 0;
};

/// @throws Error (usage) naming the purposes and how many sessions have them, when there are
/// several
void refuse_mixed_purposes(const LoggedSessions& sessions);

}  // namespace heft
