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
  /// Largest yaw of the clone relative to the hand while it touched a cube, by slot; empty without
  /// frames.
  std::map<int, double> clone_yaw_deg{};
  /// The answers that a comparison offered.
  ComparisonAnswers answers_offered = ComparisonAnswers::heavier_or_none;

  bool completed() const { return trial.status == TrialStatus::completed; }
  /// A completed comparison with an answer and a level, which offered the answers `answered`.
  bool is_usable_comparison(ComparisonAnswers answered = ComparisonAnswers::heavier_or_none) const {
    return has_comparison() && answers_offered == answered;
  }
  bool has_comparison() const;
  std::vector<double> masses_g() const;  ///< by slot
  /// Whether its cubes have these masses, given from light to heavy, and the protocol's friction.
  bool shows(std::span<const double> masses) const;
};

/// validated - shown - paused - lost, in seconds; none if the trial was not shown or not validated.
std::optional<double> response_time_s(const TrialRow& trial);

/// Camera pictures of a session; none are counted on a virtual clock.
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
  int n_lost = 0;  ///< tracking losses in trials
  /// Sums over trials: time with tracking lost; time from shown to validated, without pauses.
  double lost_s = 0, answering_s = 0;
  FrameCounts frames;  ///< none where frames were not kept
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
  std::optional<AnalysisPlan> plan{};  ///< hypotheses that its protocol declares; none: it has none
  ExclusionRules exclusion{};
  /// Its protocol's staircases by name, without choices.
  std::map<std::string, StaircaseRun> staircases{};
  /// Its conditions with the law and parameters of one of the paper's, by name.
  std::map<std::string, published::Condition> published_conditions{};
  /// Questions of its judgments, and the meaning of their answers for procedures, by block.
  std::map<std::string, JudgmentOffer> judgments{};

  /// Whether a model answered one of its trials, or, if there are no trials, was configured to.
  bool simulated() const { return model().has_value(); }
  /// The first such model, as NAME or NAME:FILE.
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

/// Notes, deviations, unblindings and checks that were not passed, in order.
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

/// Names of a protocol's staircases whose kind estimates nothing; empty if the text is no protocol.
std::set<std::string> staircases_without_jnd(const std::string& protocol_text);

/// Joins each attempt's rows. Rows of an attempt that has no trial row are left out.
SessionData join_rows(const SessionRow& session, const SessionRows& rows);

struct Dataset {
  std::string database;  ///< the logs' file names, as given
  std::vector<SessionData> sessions;
};

/// The sessions of one or several logs, read one at a time so that only one is in memory.
class LoggedSessions {
 public:
  /// @param session_ids which, of a single log; empty: all
  /// @throws Error when a file can't be read, is given twice or has no such session; (usage) when
  ///   sessions of several logs are named
  LoggedSessions(const std::vector<std::string>& databases,
                 const std::vector<std::int64_t>& session_ids);

  /// The logs' files, as given.
  std::string database() const;
  /// Visits each session in order; the same ones in every call. With several logs, participants are
  /// named by person_name(), and each log counts as a lab.
  void each(const std::function<void(const SessionData&)>& use) const;
  /// Sessions without data, because they were withdrawn.
  int n_withdrawn() const { return n_withdrawn_; }
  /// Number of sessions by purpose.
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
