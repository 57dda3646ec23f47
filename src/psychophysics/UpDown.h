// The up-down staircase as a pure value: levels, steps, reversals, bounds, the end and the
// estimate. No I/O, no clock, no randomness. Law and choices: Levitt (1971); Leek (2001); for the
// paper's rule its section 4.2.1.
//
// A positive answer (perceived, correct) counts towards a move down, a negative one towards a move
// up. A move is due after `down` positive or `up` negative answers in a row; an opposite answer
// starts the other count again, a due move both. A due move opposite to the previous due move is a
// reversal, whether or not a bound leaves it room; the first due move never is one. Its value is
// the level presented on that trial. The answer that ends a staircase makes no move.
//
// What the literature leaves open, other programs decide like this. PsychoPy, expyfun and the Unity
// Staircase Procedure toolkit change the step before the reversal's own move, pychoacoustics after
// it. PsychoPy clamps and counts no clamp as a reversal; expyfun clamps and lets its user choose
// (repeat_limit); Palamedes with truncate = "no" and the Unity toolkit without strict limits let
// the inner level continue beyond the bound. PsychoPy with applyInitialRule and Palamedes are
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

/// At a bound, either the level itself stops there, or it continues beyond and only what is
/// presented stays at the bound.
enum class AtBound { clamp, virtual_level };
template <>
struct EnumNames<AtBound> {
  static constexpr std::array<std::string_view, 2> names{"clamp", "virtual"};
};

/// Whether the step that a reversal changes applies to the move that it makes, or from the next one
/// on.
enum class ChangeStep { before_move, after_move };
template <>
struct EnumNames<ChangeStep> {
  static constexpr std::array<std::string_view, 2> names{"before_move", "after_move"};
};

/// What makes an estimate censored: a bound that cut the move to the level of a reversal that
/// counts, or, as sessions of logs before version 6 recorded it, every such reversal at a bound,
/// also where a step ended on it exactly.
enum class CensoringRule { cut_moves, levels_at_bounds };

/// Ten decades at once leave every scale of levels.
constexpr double largest_step(StepScale scale) {
  return scale == StepScale::linear ? furthest : scale == StepScale::db ? 200 : 10;
}

struct UpDownConfig {
  static constexpr std::string_view kind = "up_down";
  using Procedure = class UpDown;

  double start = 0;
  /// Steps after 0, 1, 2... reversals; the last one repeats. Used when not empty; otherwise `step`,
  /// halved every `halve_every` reversals (0: never) and at least `min_step`.
  std::vector<double> steps{};
  std::vector<double> steps_up{};  ///< for upward moves; empty: the same as down
  std::optional<double> step{};
  int halve_every = 0;
  double min_step = 0;
  StepScale step_scale = StepScale::linear;
  int up = 1;    ///< consecutive negative answers before a move up
  int down = 1;  ///< consecutive positive answers before a move down
  bool initial_1up1down =
      false;  ///< 1-up-1-down until the first reversal, and for the answer making it
  std::optional<double> floor{}, ceiling{};  ///< none: no bound
  AtBound at_bound = AtBound::clamp;
  /// A due move that would pass the bound counts as a reversal too, also when it has the
  /// direction of the last one; whether it would is judged by the step without it. So someone who
  /// always says yes ends by reversals, with an estimate at the floor. Reaching the bound exactly
  /// is no reversal, and no answer makes two.
  bool bound_is_reversal = false;
  ChangeStep change_step = ChangeStep::before_move;
  int stop_reversals = 10;
  int min_trials = 0;     ///< reversals end it only from this many trials on; more are recorded
  int stop_trials = 200;  ///< a hard limit
  int discard_reversals = 2;
  CensoringRule censoring = CensoringRule::cut_moves;  ///< no key of a file

  /// "from 175 g, steps 50 g, halved every 2 reversals". @param unit of levels
  std::string course(std::string_view unit) const;

  ConfigMistakes check() const;
  /// Mistakes where levels are differences from a reference: a difference that is perceived, or
  /// not, means the opposite where the comparison is the lighter one, so that levels must not get
  /// there.
  ConfigMistakes check_beside(double reference) const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, UpDownConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"step_scale", "what steps are: differences, or ratios in dB or decades"},
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
  visit(ConfigKey{"steps_up", "the same for upward moves, where they differ"}, config.steps_up,
        steps);
  const Range levels = is_ratio ? zero_or_more : any_number;
  visit(ConfigKey{"floor", "lowest level", false, "floor {} g"}, config.floor, levels);
  visit(ConfigKey{"ceiling", "highest level", false, "ceiling {} g"}, config.ceiling, levels);
  visit(ConfigKey{"up", "negative answers in a row before a move up"}, config.up, WholeRange{1});
  visit(ConfigKey{"down", "positive answers in a row before a move down"}, config.down,
        WholeRange{1});
  visit(ConfigKey{"initial_1up1down", "1-up-1-down until the first reversal"},
        config.initial_1up1down);
  visit(ConfigKey{"at_bound", "the level stops at a bound, or only what is presented does"},
        config.at_bound);
  visit(ConfigKey{"bound_is_reversal", "a move that a bound cuts counts as a reversal"},
        config.bound_is_reversal);
  visit(ConfigKey{"change_step", "whether a reversal's own move has the new step", false,
                  "step changes {}"},
        config.change_step);
  visit(ConfigKey{"stop_reversals", "reversals that end it"}, config.stop_reversals, WholeRange{1});
  visit(ConfigKey{"min_trials", "trials before which reversals don't end it"}, config.min_trials,
        WholeRange{});
  visit(ConfigKey{"stop_trials", "trials that end it", false, "at most {} trials"},
        config.stop_trials, WholeRange{1});
  visit(ConfigKey{"discard_reversals", "first reversals that the estimate leaves out"},
        config.discard_reversals, WholeRange{});
}

class UpDown {
 public:
  /// @throws InvalidConfig with all that config.check() finds
  explicit UpDown(UpDownConfig config);

  /// Level to present next: the planned level held within the bounds.
  double level() const;

  /// Takes the answer to a trial. Undefined after the end (check finished()).
  /// @param shown the level really shown where it was not level(), within +-largest_level; the
  ///   reversal's value, while the next level still follows the planned one
  Update respond(bool positive, std::optional<double> shown = std::nullopt);

  // As every procedure.
  double next_level(const RandomStream&) const { return level(); }
  Update respond(const Response& response, double shown) {
    return respond(response.positive, shown);
  }
  std::vector<Estimate> estimates() const;
  std::optional<int> planned_trials() const { return std::nullopt; }
  std::vector<double> planned_levels() const { return {presented(config_.start)}; }

  bool finished() const { return finish_.has_value(); }
  std::optional<StopReason> finish() const { return finish_; }
  /// Mean level of the reversals but the first `discard_reversals`; none if there is none left.
  std::optional<double> estimate() const;

  const UpDownConfig& config() const { return config_; }
  const std::vector<Reversal>& reversals() const { return reversals_; }
  int n_trials() const { return n_trials_; }
  /// Moves that the floor (ceiling) cut short.
  int n_floor() const { return n_floor_; }
  int n_ceiling() const { return n_ceiling_; }

 private:
  enum class Direction { down, up };

  struct Move {
    Direction direction;
    double target;  ///< level that it leads to, not yet held within the bounds
    bool is_reversal;
    bool turned;  ///< opposite to the due move before it
  };

  std::optional<Direction> due_direction(bool positive);
  std::optional<Move> due_move(bool positive);
  Reversal add_reversal(const Move& move, double shown_level);
  void make(const Move& move);
  double step(Direction direction, std::size_t n_reversals) const;
  double moved(double level, Direction direction, double step) const;
  double landed(double target) const;
  double presented(double level) const;
  double inner_level() const;
  bool passes_bound(const Move& move) const;
  Censored side_of(double target, double shown) const;
  Censored censored() const;
  std::optional<StopReason> reason_to_finish() const;

  UpDownConfig config_;
  double target_ = 0;  ///< level that the last move led to, not held within the bounds
  int n_positive_ = 0, n_negative_ = 0;  ///< consecutive, since the last due move
  std::optional<Direction> last_due_;
  std::vector<Reversal> reversals_;
  bool cut_below_ = false, cut_above_ = false;  ///< reversals that count, by a bound
  int n_trials_ = 0, n_floor_ = 0, n_ceiling_ = 0;
  std::optional<StopReason> finish_;
};

}  // namespace heft
