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
// the inner level go on beyond the bound. PsychoPy with applyInitialRule and Palamedes are
// 1-up-1-down until the first reversal.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

enum class StepScale { linear, db, log10 };
template <>
struct EnumNames<StepScale> {
  static constexpr std::array<std::string_view, 3> names{"linear", "db", "log10"};
};

/// At a bound, either the level itself stops there, or it goes on inside and only what is presented
/// stays at the bound.
enum class AtBound { clamp, virtual_level };
template <>
struct EnumNames<AtBound> {
  static constexpr std::array<std::string_view, 2> names{"clamp", "virtual"};
};

/// Whether the step that a reversal changes is in force for the move it makes, or from the next.
enum class ChangeStep { before_move, after_move };
template <>
struct EnumNames<ChangeStep> {
  static constexpr std::array<std::string_view, 2> names{"before_move", "after_move"};
};

/// What makes an estimate censored: a bound that cut the move to the level of a reversal that
/// counts, or, as sessions of logs before version 6 recorded it, every such reversal at a bound,
/// also where a step ended on it exactly.
enum class CensoringRule { cut_moves, levels_at_bounds };

struct UpDownConfig {
  static constexpr std::string_view kind = "up_down";
  using Procedure = class UpDown;

  double start = 0;
  /// Steps in force after 0, 1, 2... reversals; the last one repeats. Used when not empty;
  /// otherwise `step`, halved every `halve_every` reversals (0: never) and at least `min_step`.
  std::vector<double> steps{};
  std::vector<double> steps_up{};  ///< own list for upward moves; empty: the same as down
  double step = 0;
  int halve_every = 0;
  double min_step = 0;
  StepScale step_scale = StepScale::linear;
  int up = 1;    ///< consecutive negative answers before a move up
  int down = 1;  ///< consecutive positive answers before a move down
  bool initial_1up1down =
      false;  ///< 1-up-1-down until the first reversal, and for the answer making it
  std::optional<double> floor{}, ceiling{};  ///< none: no bound
  AtBound at_bound = AtBound::clamp;
  /// A due move that would pass the bound counts as a reversal too, also when it goes on in the
  /// direction of the last one; whether it would is judged by the step in force without it. So
  /// someone who always says yes ends by reversals, with an estimate at the floor. Reaching the
  /// bound exactly is no reversal, and no answer makes two.
  bool bound_is_reversal = false;
  ChangeStep change_step = ChangeStep::before_move;
  int stop_reversals = 10;
  int min_trials = 0;     ///< reversals end it only from this many trials on; more are recorded
  int stop_trials = 200;  ///< a hard limit
  int discard_reversals = 2;
  CensoringRule censoring = CensoringRule::cut_moves;  ///< no key of a file
};

class UpDown {
 public:
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
  std::optional<Finish> finish() const { return finish_; }
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
  std::optional<Finish> reason_to_finish() const;

  UpDownConfig config_;
  double target_ = 0;  ///< level that the last move led to, not held within the bounds
  int n_positive_ = 0, n_negative_ = 0;  ///< consecutive, since the last due move
  std::optional<Direction> last_due_;
  std::vector<Reversal> reversals_;
  bool cut_below_ = false, cut_above_ = false;  ///< reversals that count, by a bound
  int n_trials_ = 0, n_floor_ = 0, n_ceiling_ = 0;
  std::optional<Finish> finish_;
};

}  // namespace heft
