#include "psychophysics/UpDown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace heft {

namespace {
double listed_step(const std::vector<double>& steps, std::size_t n_reversals) {
  return steps[std::min(n_reversals, steps.size() - 1)];
}

double halved_step(const UpDownConfig& config, std::size_t n_reversals) {
  const double step = config.step.value_or(0);
  if (config.halve_every == 0) return std::max(step, config.min_step);
  const int halvings = static_cast<int>(n_reversals) / config.halve_every;
  return std::max(std::ldexp(step, -halvings), config.min_step);
}

double held_finite(double level) {
  return std::clamp(level, -largest_level, largest_level);
}

void check_steps(const UpDownConfig& config, ConfigMistakes& mistakes) {
  if (!config.step && config.steps.empty())
    mistakes.push_back({{"step", "steps"}, R"(lacks "step" or "steps")", "one of them"});
  const auto only_one = [&](std::string_view key) {
    mistakes.push_back({{key, "steps"},
                        fmt::format("{} together with steps", key),
                        "only one of them, because the list has every step"});
  };
  if (!config.steps.empty()) {
    if (config.step) only_one("step");
    if (config.halve_every != 0) only_one("halve_every");
    if (config.min_step != 0) only_one("min_step");
  } else if (config.step && config.min_step > *config.step) {
    mistakes.push_back({{"min_step", "step"},
                        fmt::format("min_step is {}", config.min_step),
                        fmt::format("at most the step {}", *config.step)});
  }
}

void check_changes(const UpDownConfig& config, ConfigMistakes& mistakes) {
  const std::vector<double>& after = config.change_after_trials;
  if (after.empty()) return;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i] != std::floor(after[i]) || (i > 0 && after[i] <= after[i - 1]))
      mistakes.push_back({{"change_after_trials"},
                          fmt::format("change_after_trials has {}", after[i]),
                          "ascending whole numbers",
                          i});
  const bool has_steps = config.step || !config.steps.empty();
  if (has_steps && config.steps.size() != after.size() + 1)
    mistakes.push_back({{"steps", "change_after_trials"},
                        fmt::format("steps has {} steps and change_after_trials {} changes",
                                    config.steps.size(), after.size()),
                        "one step more than changes"});
}

void check_bounds(const UpDownConfig& config, ConfigMistakes& mistakes) {
  const auto& [start, floor, ceiling] = std::tie(config.start, config.floor, config.ceiling);
  if (floor && ceiling && *floor >= *ceiling) {
    mistakes.push_back({{"floor", "ceiling"},
                        fmt::format("floor is {}", *floor),
                        fmt::format("below the ceiling {}", *ceiling)});
    return;
  }
  if (floor && start < *floor)
    mistakes.push_back({{"start", "floor"},
                        fmt::format("start is {}", start),
                        fmt::format("at least the floor {}", *floor)});
  if (ceiling && start > *ceiling)
    mistakes.push_back({{"start", "ceiling"},
                        fmt::format("start is {}", start),
                        fmt::format("at most the ceiling {}", *ceiling)});
}
}  // namespace

std::string UpDownConfig::course(std::string_view unit) const {
  const std::string_view step_unit = step_scale == StepScale::linear ? unit : name_of(step_scale);
  if (!steps.empty())
    return fmt::format(
        "from {:g} {}, steps {:g} {}{}{}", start, unit, fmt::join(steps, ", "), step_unit,
        steps_up.empty()
            ? ""
            : fmt::format(" down and {:g} {} up", fmt::join(steps_up, ", "), step_unit),
        change_after_trials.empty()
            ? ""
            : fmt::format(", changed after {:g} trials", fmt::join(change_after_trials, ", ")));
  const std::string halved =
      halve_every > 0 ? fmt::format(", halved every {} reversals", halve_every) : "";
  return fmt::format("from {:g} {}, steps {:g} {}{}", start, unit, step.value_or(0), step_unit,
                     halved);
}

ConfigMistakes UpDownConfig::check() const {
  ConfigMistakes mistakes = out_of_range(*this);
  check_steps(*this, mistakes);
  check_changes(*this, mistakes);
  check_bounds(*this, mistakes);
  if (discard_reversals >= stop_reversals)
    mistakes.push_back(
        {{"discard_reversals", "stop_reversals"},
         fmt::format(
             "discard_reversals is {} and stop_reversals {}, which leaves no reversal for the "
             "estimate",
             discard_reversals, stop_reversals),
         "fewer to discard"});
  if (min_trials > stop_trials)
    mistakes.push_back({{"min_trials", "stop_trials"},
                        fmt::format("min_trials is {}", min_trials),
                        fmt::format("at most stop_trials {}", stop_trials)});
  return mistakes;
}

ConfigMistakes UpDownConfig::check_beside(double reference, bool either_sign) const {
  if (either_sign && floor && *floor < 0 && *floor > -reference) return {};
  if (either_sign && !(floor && *floor >= 0) && (floor || step_scale == StepScale::linear))
    return {{{"floor", "step_scale"},
             floor
                 ? fmt::format("floor is {}: with a reference of {} g the comparison could "
                               "weigh 0 g or less",
                               *floor, reference)
                 : std::string(R"(lacks "floor": its linear steps could make the comparison weigh )"
                               "0 g or less"),
             fmt::format("a floor above {}", -reference)}};
  if (floor && *floor < 0)
    return {{{"floor"},
             fmt::format(
                 "floor is {}: the comparison could become lighter than the reference of {} g, for "
                 "which this staircase's responses have the opposite meaning",
                 *floor, reference),
             "0 or more"}};
  if (!floor && step_scale == StepScale::linear)
    return {
        {{"floor", "step_scale"},
         R"(lacks "floor": its linear steps could make the comparison lighter than the reference)",
         "a floor of 0 or more"}};
  return {};
}

UpDown::UpDown(UpDownConfig config)
    : config_(valid_config(std::move(config))), target_(config_.start) {
  constexpr int most = 1000;  // of a rule that usually ends by its trials
  reversals_.reserve(static_cast<std::size_t>(std::min(config_.stop_reversals, most)));
}

double UpDown::level() const {
  return presented(target_);
}

// The level that the next step starts from.
double UpDown::inner_level() const {
  return config_.at_bound == AtBound::clamp ? presented(target_) : target_;
}

Update UpDown::respond(bool positive, std::optional<double> shown) {
  assert(!finished());
  const double shown_level = shown.value_or(level());
  ++n_trials_;
  Update update;
  const std::optional<Move> move = due_move(positive);
  if (move && move->is_reversal) update.reversal = add_reversal(*move, shown_level);
  update.finish = finish_ = reason_to_finish();
  if (move && !finish_) make(*move);
  return update;
}

std::optional<double> UpDown::estimate() const {
  const auto n_discarded = static_cast<std::size_t>(config_.discard_reversals);
  if (reversals_.size() <= n_discarded) return std::nullopt;
  const auto first = reversals_.begin() + config_.discard_reversals;
  const double sum =
      std::accumulate(first, reversals_.end(), 0.0,
                      [](double so_far, const Reversal& r) { return so_far + r.level; });
  return sum / static_cast<double>(reversals_.size() - n_discarded);
}

std::vector<Estimate> UpDown::estimates() const {
  return {{.method = "mean_of_reversals",
           .value = estimate(),
           .n_trials = n_trials_,
           .n_reversals = static_cast<int>(reversals_.size()),
           .n_floor = n_floor_,
           .n_ceiling = n_ceiling_,
           .censored = censored()}};
}

// Judged by the reversals in the estimate, or without an estimate by the current level.
Censored UpDown::censored() const {
  const Censored last = estimate() ? Censored::none : side_of(target_, level());
  const bool below = cut_below_ || last == Censored::below;
  const bool above = cut_above_ || last == Censored::above;
  if (below != above) return above ? Censored::above : Censored::below;
  return above || finish_ == StopReason::trials ? Censored::indeterminate : Censored::none;
}

// The bound that shortened the move to `target` by more than rounding; by the older rule, the bound
// at the presented level.
Censored UpDown::side_of(double target, double shown) const {
  const bool by_level = config_.censoring == CensoringRule::levels_at_bounds;
  const auto is_beyond = [&](double beyond, double bound) {
    return by_level ? beyond >= 0 : beyond > 1e-9 * std::abs(bound);
  };
  const double level = by_level ? shown : target;
  if (config_.floor && is_beyond(*config_.floor - level, *config_.floor)) return Censored::below;
  if (config_.ceiling && is_beyond(level - *config_.ceiling, *config_.ceiling))
    return Censored::above;
  return Censored::none;
}

std::optional<UpDown::Direction> UpDown::due_direction(bool positive) {
  int& run = positive ? n_positive_ : n_negative_;
  int& other = positive ? n_negative_ : n_positive_;
  other = 0;
  ++run;
  const bool initially = config_.initial_1up1down && reversals_.empty();
  if (!initially && run < (positive ? config_.down : config_.up)) return std::nullopt;
  run = 0;
  return positive ? Direction::down : Direction::up;
}

std::optional<UpDown::Move> UpDown::due_move(bool positive) {
  const std::optional<Direction> direction = due_direction(positive);
  if (!direction) return std::nullopt;
  const bool turned = last_due_ && *last_due_ != *direction;
  const bool new_step = turned && config_.change_step == ChangeStep::before_move;
  last_due_ = direction;
  const double size = step(*direction, reversals_.size() + (new_step ? 1 : 0));
  Move move{*direction, landed(moved(inner_level(), *direction, size)), turned, turned};
  if (config_.bound_is_reversal && passes_bound(move)) move.is_reversal = true;
  return move;
}

// A reversal by bound_is_reversal alone is censored by that bound.
Reversal UpDown::add_reversal(const Move& move, double shown_level) {
  const int n_before = static_cast<int>(reversals_.size());
  const auto n = static_cast<std::size_t>(n_before);
  reversals_.push_back(
      {n_before + 1, shown_level, step(move.direction, n), step(move.direction, n + 1)});
  if (n_before >= config_.discard_reversals) {
    Censored side = side_of(target_, shown_level);
    if (side == Censored::none && !move.turned) side = side_of(move.target, shown_level);
    cut_below_ = cut_below_ || side == Censored::below;
    cut_above_ = cut_above_ || side == Censored::above;
  }
  return reversals_.back();
}

std::size_t UpDown::n_step_changes(std::size_t n_reversals) const {
  const std::vector<double>& after = config_.change_after_trials;
  if (after.empty()) return n_reversals;
  return static_cast<std::size_t>(
      std::count_if(after.begin(), after.end(), [&](double n) { return n_trials_ >= n; }));
}

double UpDown::step(Direction direction, std::size_t n_reversals) const {
  const std::size_t n_changes = n_step_changes(n_reversals);
  if (direction == Direction::up && !config_.steps_up.empty())
    return listed_step(config_.steps_up, n_changes);
  if (!config_.steps.empty()) return listed_step(config_.steps, n_changes);
  return halved_step(config_, n_reversals);
}

// Downward steps on a ratio scale divide by the factor of upward steps, as in PsychoPy, whose
// traces are reproduced to the last bit.
double UpDown::moved(double level, Direction direction, double step) const {
  const bool up = direction == Direction::up;
  if (config_.step_scale == StepScale::linear) return held_finite(up ? level + step : level - step);
  const double factor = std::pow(10.0, config_.step_scale == StepScale::db ? step / 20.0 : step);
  return held_finite(up ? level * factor : level / factor);
}

// A linear step that ends within a billionth of its size from a bound of 0 ends on it: .3 - .1 - .1
// - .1 is not 0, and the rounding error would be the whole level. At other bounds the error is a
// last bit, which is kept as in other programs.
double UpDown::landed(double target) const {
  if (config_.step_scale != StepScale::linear) return target;
  const bool has_zero = config_.floor == 0.0 || config_.ceiling == 0.0;
  return has_zero && std::abs(target) <= 1e-9 * std::abs(target - inner_level()) ? 0 : target;
}

double UpDown::presented(double level) const {
  if (config_.floor) level = std::max(level, *config_.floor);
  if (config_.ceiling) level = std::min(level, *config_.ceiling);
  return level;
}

bool UpDown::passes_bound(const Move& move) const {
  return move.direction == Direction::down ? config_.floor && move.target < *config_.floor
                                           : config_.ceiling && move.target > *config_.ceiling;
}

void UpDown::make(const Move& move) {
  if (passes_bound(move)) ++(move.direction == Direction::down ? n_floor_ : n_ceiling_);
  target_ = move.target;
}

std::optional<StopReason> UpDown::reason_to_finish() const {
  const int n_reversals = static_cast<int>(reversals_.size());
  if (n_reversals >= config_.stop_reversals && n_trials_ >= config_.min_trials)
    return StopReason::reversals;
  if (n_trials_ >= config_.stop_trials) return StopReason::trials;
  return std::nullopt;
}

}  // namespace heft
