// The up-down staircase (Levitt 1971; Leek 2001; the paper's rule: its section 4.2.1) as a pure
// value: level, steps, reversals, bounds, stop rule, estimate.
//
// A positive response (perceived, correct) counts towards a move down, a negative one towards a
// move up. A move is due after `down` positive or `up` negative responses in a row. A response of
// the other kind restarts the count, and so does a due move. A due move opposite to the previous
// due move is a reversal, even if a bound prevents the move; the first due move is never one. Its
// value is the level presented in that trial. The response that ends the staircase makes no move.
//
// Programs differ where the literature leaves choices open. PsychoPy, expyfun and the Unity
// Staircase Procedure toolkit change the step before the reversal's move, pychoacoustics after it.
// PsychoPy clamps levels and counts no clamped move as a reversal; expyfun clamps and offers a
// choice (repeat_limit); Palamedes with truncate = "no" and the Unity toolkit without strict limits
// let the internal level pass the bound. PsychoPy with applyInitialRule and Palamedes are
// 1-up-1-down until the first reversal.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

enum class StepScale { linear, db, log10 };
template <>
struct EnumNames<StepScale> {
  static constexpr std::array<std::string_view, 3> names{"linear", "db", "log10"};
};

/// At a bound, either the level is clamped, or an internal level passes the bound and only the
/// presented level is clamped.
enum class AtBound { clamp, virtual_level };
template <>
struct EnumNames<AtBound> {
  static constexpr std::array<std::string_view, 2> names{"clamp", "virtual"};
};

/// Whether the step changed by a reversal applies to the reversal's move or from the next move.
enum class ChangeStep { before_move, after_move };
template <>
struct EnumNames<ChangeStep> {
  static constexpr std::array<std::string_view, 2> names{"before_move", "after_move"};
};

/// When an estimate is censored: a bound shortened the move to the level of a reversal in the
/// estimate (cut_moves); or, as in logs before version 6, such a reversal is at a bound, even if a
/// step ended exactly there (levels_at_bounds).
enum class CensoringRule { cut_moves, levels_at_bounds };

/// A step of ten decades leaves every range of levels.
constexpr double largest_step(StepScale scale) {
  return scale == StepScale::linear ? furthest : scale == StepScale::db ? 200 : 10;
}

struct UpDownConfig {
  static constexpr std::string_view kind = "up_down";
  using Procedure = class UpDown;

  double start = 0;  ///< level of the first trial, within the bounds
  /// Steps after 0, 1, 2... reversals; the last one repeats. If empty: `step`, halved every
  /// `halve_every` reversals (0: never), at least `min_step`. In the unit of levels, in dB (20 a
  /// decade) or in decades, see step_scale.
  std::vector<double> steps{};
  std::vector<double> steps_up{};  ///< for upward moves; empty: the same as down
  /// If given: `steps` and `steps_up` instead change after these numbers of trials (expyfun's
  /// change_rule = "trials").
  std::vector<double> change_after_trials{};
  std::optional<double> step{};
  int halve_every = 0;
  double min_step = 0;
  StepScale step_scale = StepScale::linear;
  int up = 1;    ///< consecutive negative responses before a move up
  int down = 1;  ///< consecutive positive responses before a move down
  /// 1-up-1-down up to and including the response that makes the first reversal.
  bool initial_1up1down = false;
  std::optional<double> floor{}, ceiling{};  ///< none: no bound
  AtBound at_bound = AtBound::clamp;
  /// A due move that would pass a bound is a reversal, also in the direction of the last move. The
  /// test uses the step before this reversal. A participant who always answers yes then ends by
  /// reversals, with an estimate at the floor. A move that ends exactly at the bound is no
  /// reversal, and no response makes two.
  bool bound_is_reversal = false;
  ChangeStep change_step = ChangeStep::before_move;
  int stop_reversals = 10;
  int min_trials = 0;         ///< trials before which reversals do not end it
  int stop_trials = 200;      ///< trials that end it in any case
  int discard_reversals = 2;  ///< first reversals that the estimate leaves out
  CensoringRule censoring = CensoringRule::cut_moves;  ///< not a key of files

  /// "from 175 g, steps 50 g, halved every 2 reversals". @param unit of levels
  std::string course(std::string_view unit) const;

  ConfigMistakes check() const;
  /// Mistakes if levels are differences from a reference in grams. For a comparison lighter than
  /// the reference a perceived difference has the opposite meaning, so levels must not be negative,
  /// except with `either_sign`, where a positive response says that the comparison was chosen.
  ConfigMistakes check_beside(double reference, bool either_sign = false) const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, UpDownConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"step_scale", "steps are differences, or ratios in dB or decades"},
        config.step_scale);
  const bool is_ratio = config.step_scale != StepScale::linear;
  const Range steps{0, largest_step(config.step_scale), true};
  visit(ConfigKey{"start", "first level", true}, config.start, is_ratio ? above_zero : any_number);
  visit(ConfigKey{"step", "first step"}, config.step, steps);
  visit(ConfigKey{"halve_every", "reversals after which the step halves; 0: never"},
        config.halve_every, WholeRange{});
  visit(ConfigKey{"min_step", "smallest step"}, config.min_step, Range{0, steps.high});
  visit(ConfigKey{"steps", "instead: steps after 0, 1, 2... reversals; the last one repeats"},
        config.steps, steps);
  visit(ConfigKey{"steps_up", "steps of upward moves, if different"}, config.steps_up, steps);
  visit(
      ConfigKey{"change_after_trials", "numbers of trials after which steps change, not reversals"},
      config.change_after_trials, Range{1});
  const Range levels = is_ratio ? zero_or_more : any_number;
  visit(ConfigKey{"floor", "lowest level", false, "floor {} g"}, config.floor, levels);
  visit(ConfigKey{"ceiling", "highest level", false, "ceiling {} g"}, config.ceiling, levels);
  visit(ConfigKey{"up", "consecutive negative responses before a move up", false, "{} up"},
        config.up, WholeRange{1});
  visit(ConfigKey{"down", "consecutive positive responses before a move down", false, "{} down"},
        config.down, WholeRange{1});
  visit(ConfigKey{"initial_1up1down", "1-up-1-down until the first reversal"},
        config.initial_1up1down);
  visit(ConfigKey{"at_bound", "clamp the level at a bound, or only the presented level"},
        config.at_bound);
  visit(ConfigKey{"bound_is_reversal", "a move that would pass a bound is a reversal"},
        config.bound_is_reversal);
  visit(ConfigKey{"change_step", "whether a reversal's move has the new step", false,
                  "step changes {}"},
        config.change_step);
  visit(ConfigKey{"stop_reversals", "reversals that end it", false, "ends after {} reversals"},
        config.stop_reversals, WholeRange{1});
  visit(ConfigKey{"min_trials", "trials before which reversals do not end it"}, config.min_trials,
        WholeRange{});
  visit(ConfigKey{"stop_trials", "trials that end it", false, "at most {} trials"},
        config.stop_trials, WholeRange{1});
  visit(ConfigKey{"discard_reversals", "first reversals that the estimate leaves out", false,
                  "first {} reversals left out"},
        config.discard_reversals, WholeRange{});
}

class UpDown {
 public:
  /// @throws InvalidConfig with all mistakes of config.check()
  explicit UpDown(UpDownConfig config);

  /// The level to present next: the planned level, clamped to the bounds.
  double level() const;

  /// Records the response to a trial. Undefined after the end (see finished()).
  /// @param shown the level that was presented, if not level(), within +-largest_level. It is the
  ///   value of a reversal; the next level follows the planned level.
  Update respond(bool positive, std::optional<double> shown = std::nullopt);

  // Members of every ProcedureKind.
  double next_level(const RandomStream&) const { return level(); }
  Update respond(const Response& response, double shown) {
    return respond(response.positive, shown);
  }
  std::vector<Estimate> estimates() const;
  std::optional<int> planned_trials() const { return std::nullopt; }
  std::vector<double> planned_levels() const { return {presented(config_.start)}; }

  bool finished() const { return finish_.has_value(); }
  std::optional<StopReason> finish() const { return finish_; }
  /// Mean level of the reversals after the first `discard_reversals`; none without such reversals.
  std::optional<double> estimate() const;

  const UpDownConfig& config() const { return config_; }
  const std::vector<Reversal>& reversals() const { return reversals_; }
  int n_trials() const { return n_trials_; }
  /// Moves that the floor (ceiling) shortened.
  int n_floor() const { return n_floor_; }
  int n_ceiling() const { return n_ceiling_; }

 private:
  enum class Direction { down, up };

  struct Move {
    Direction direction;
    double target;  ///< level after the move, not clamped
    bool is_reversal;
    bool turned;  ///< opposite to the previous due move
  };

  std::optional<Direction> due_direction(bool positive);
  std::optional<Move> due_move(bool positive);
  Reversal add_reversal(const Move& move, double shown_level);
  void make(const Move& move);
  double step(Direction direction, std::size_t n_reversals) const;
  std::size_t n_step_changes(std::size_t n_reversals) const;
  double moved(double level, Direction direction, double step) const;
  double landed(double target) const;
  double presented(double level) const;
  double inner_level() const;
  bool passes_bound(const Move& move) const;
  Censored side_of(double target, double shown) const;
  Censored censored() const;
  std::optional<StopReason> reason_to_finish() const;

  UpDownConfig config_;
  double target_ = 0;                    ///< level after the last move, not clamped
  int n_positive_ = 0, n_negative_ = 0;  ///< consecutive, since the last due move
  std::optional<Direction> last_due_;
  std::vector<Reversal> reversals_;
  bool cut_below_ = false, cut_above_ = false;  ///< reversals in the estimate, censored
  int n_trials_ = 0, n_floor_ = 0, n_ceiling_ = 0;
  std::optional<StopReason> finish_;
};

}  // namespace heft
