// Just noticeable differences: what the staircases estimated, by reference mass.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/StaircaseAnswers.h"
#include "analysis/dataset/StudyEstimate.h"
#include "inference/CensoredMean.h"
#include "inference/Statistics.h"

namespace heft {

/// The paper's JND: mean level of a staircase's reversals but the first ones.
inline constexpr std::string_view jnd_method = "mean_of_reversals";

/// Reference, condition and JND method (the first of the procedure's) of a staircase. Ordered by
/// reference.
struct Compared {
  double reference_g = 0;  ///< 0: none, single cubes were judged
  std::string condition;
  std::string method{jnd_method};
  std::string block{};  ///< of a judgment; empty: a comparison

  auto operator<=>(const Compared&) const = default;
};

/// One finished staircase.
struct StaircaseResult {
  std::int64_t session_id = 0;
  std::string participant, staircase;
  Compared compared;
  std::optional<double> jnd_g;          ///< as logged; none: it ended with too few reversals
  std::optional<double> low_g, high_g;  ///< its interval; none: the method gives none
  int n_trials = 0, n_reversals = 0;
  int n_floor = 0, n_ceiling = 0;  ///< moves that a bound cut short
  StopReason reason = StopReason::reversals;
  /// above, below: the JND is only known to be beyond `shown_g`; otherwise indeterminate.
  Censored censored = Censored::none;
  std::string why{};  ///< "at the ceiling", "trial limit", "3 reversals"...; empty: not censored
  /// The JND; if it is censored, its known bound; none if neither is known.
  std::optional<double> shown_g{};
  double start_g = 0;  ///< the first level presented
};

/// None if neither JND nor bound is known.
std::optional<CensoredValue> censored_value(const StaircaseResult& result);

/// Estimate of one or several staircases: the JND or its bound, and the JND by the paper's rule,
/// which takes a censored one as exact.
struct JndFigure {
  std::optional<CensoredValue> censored, as_logged;
};

/// A staircase that ended with fewer is censored.
inline constexpr int least_reversals = 4;

/// One participant's JND at a reference: the mean over sessions of each session's mean staircase,
/// censored if one of the staircases is, in the same direction.
struct ParticipantJnd {
  std::string participant;
  double jnd_g = 0;  ///< if censored, the value that it lies above or below
  Censored censored = Censored::none;
};

/// Mean over the participants with a JND by the paper's rule; sd over n-1.
struct PaperMean {
  std::optional<double> mean, sd;
  int n = 0;
};

/// Participants' JNDs at a reference, and their mean.
struct Jnds : FigureSummary {
  PaperMean by_paper;
  std::vector<ParticipantJnd> participants;  ///< with a figure, exact or censored
  /// Participants without a figure: a staircase is unfinished, has neither JND nor direction, or
  /// one is censored above and another one below.
  std::vector<std::string> missing;
  std::string why_withheld{};  ///< why all are missing

  void add(const std::string& participant, const JndFigure& figure);
  void put_means(FigureModel model);  ///< when all are added
  /// Makes the figures of all participants missing.
  void withhold(const std::string& why);
  int n() const { return static_cast<int>(participants.size() + missing.size()); }
  int n_censored(Censored direction) const;
  /// Those that the mean takes as exact: JNDs of 0 g have no logarithm, and are below the others.
  std::vector<double> exact_g() const;

 private:
  std::vector<double> as_logged_g_;
  FigureModel model_ = FigureModel::normal;
};

/// Copies the mean and its interval to an estimate.
void set_mean(StudyEstimate& estimate, const Jnds& jnds);
/// Appends each participant's JND. @param of the other fields of the estimates
void put_participants(Estimates& all, StudyEstimate of, const Jnds& jnds);

/// JNDs of staircases from above and from below at one reference. Their difference measures the
/// effect of the start. A participant without both in one session is missing.
struct StartEffect {
  Jnds from_above_g, from_below_g, difference_g;
};

struct ReferenceJnd {
  Compared compared;
  /// By start, if staircases of a session differ in it: those that begin above the middle between
  /// the highest and the lowest start, and those below. None: there is one start.
  std::optional<StartEffect> starts;
  /// All staircases together; comparable with the paper only if there is one start.
  Jnds overall;
  int n_staircases = 0;  ///< finished
  int n_unfinished = 0;  ///< started in a session that did not finish them
  int n_without_estimate = 0;
  double mean_trials = 0;  ///< per finished staircase
  int least_trials = 0, most_trials = 0;
  int n_trial_limit = 0;           ///< staircases that it ended
  int n_floor = 0, n_ceiling = 0;  ///< hits, all staircases
  int n_floor_staircases = 0, n_ceiling_staircases = 0;
  /// The paper's figure, if all sessions had its technique and one of its references; otherwise
  /// null.
  const published::Figure* published = nullptr;

  void withhold(const std::string& why);
  /// Staircases that began as the paper's did, from above.
  const Jnds& as_published() const;
};

/// Collects the sessions' staircases of one task.
class StaircaseCollector {
 public:
  explicit StaircaseCollector(std::string_view task = "comparison");
  void add(const SessionData& data);

  /// Finished staircases in the order of sessions and estimates, each with the reference of its
  /// trials.
  const std::deque<StaircaseResult>& results() const { return results_; }
  /// By reference, lightest first, and condition.
  std::vector<ReferenceJnd> jnds() const;

  /// How many staircases each participant's sessions began.
  using Began = std::map<std::string, std::map<std::int64_t, int>>;
  /// One participant's figures at one reference, by where the staircases of a session began.
  struct AboveAndBelow {
    std::vector<JndFigure> above, below;
  };

 private:
  void add_starts(const std::string& participant, std::span<const StaircaseResult> of_session);

  std::string task_;
  std::deque<StaircaseResult> results_;
  StaircaseAnswers answers_;
  std::map<Compared, Began> began_;
  std::map<Compared, published::Comparable> comparable_;
  std::map<Compared, std::map<std::string, AboveAndBelow>> starts_;
};

}  // namespace heft
