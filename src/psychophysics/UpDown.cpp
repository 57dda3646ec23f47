#include "psychophysics/UpDown.h"

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
  if (config.halve_every == 0) return std::max(config.step, config.min_step);
  const int halvings = static_cast<int>(n_reversals) / config.halve_every;
  return std::max(std::ldexp(config.step, -halvings), config.min_step);
}

double held_finite(double level) {
  return std::clamp(level, -largest_level, largest_level);
}
}  // namespace

UpDown::UpDown(UpDownConfig config) : config_(std::move(config)) {
  planned_ = config_.at_bound == AtBound::clamp ? presented(config_.start) : config_.start;
}

double UpDown::level() const {
  return presented(planned_);
}

Update UpDown::respond(bool positive, std::optional<double> shown) {
  assert(!finished());
  const double shown_level = shown.value_or(level());
  ++n_trials_;
  Update update;
  const std::optional<Move> move = due_move(positive);
  if (move && move->is_reversal) update.reversal = add_reversal(move->direction, shown_level);
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

// By the reversals that count, or where there are none by the level that it got to.
Censored UpDown::censored() const {
  bool at_floor = false, at_ceiling = false;
  const auto look_at = [&](double level) {
    at_floor = at_floor || (config_.floor && level <= *config_.floor);
    at_ceiling = at_ceiling || (config_.ceiling && level >= *config_.ceiling);
  };
  for (std::size_t i = static_cast<std::size_t>(config_.discard_reversals); i < reversals_.size();
       ++i)
    look_at(reversals_[i].level);
  if (!estimate()) look_at(level());
  if (at_floor != at_ceiling) return at_ceiling ? Censored::above : Censored::below;
  return at_ceiling || finish_ == Finish::trials ? Censored::unsettled : Censored::none;
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
  Move move{*direction, landed(moved(planned_, *direction, size)), turned};
  if (config_.bound_is_reversal && passes_bound(move)) move.is_reversal = true;
  return move;
}

Reversal UpDown::add_reversal(Direction direction, double shown_level) {
  const std::size_t n_before = reversals_.size();
  reversals_.push_back({static_cast<int>(n_before) + 1, shown_level, step(direction, n_before),
                        step(direction, n_before + 1)});
  return reversals_.back();
}

double UpDown::step(Direction direction, std::size_t n_reversals) const {
  if (direction == Direction::up && !config_.steps_up.empty())
    return listed_step(config_.steps_up, n_reversals);
  if (!config_.steps.empty()) return listed_step(config_.steps, n_reversals);
  return halved_step(config_, n_reversals);
}

// Downward steps on a ratio scale divide by the factor of upward ones, as PsychoPy does, so that
// its traces come out to the last bit.
double UpDown::moved(double level, Direction direction, double step) const {
  const bool up = direction == Direction::up;
  if (config_.step_scale == StepScale::linear) return held_finite(up ? level + step : level - step);
  const double factor = std::pow(10.0, config_.step_scale == StepScale::db ? step / 20.0 : step);
  return held_finite(up ? level * factor : level / factor);
}

// A linear step that ends a billionth of itself beside a bound of 0 was to end on it: .3 - .1 - .1
// - .1 is not 0, and what rounding leaves over would be the whole level. Beside other bounds it is
// a last bit, and there other programs' bits are kept.
double UpDown::landed(double target) const {
  if (config_.step_scale != StepScale::linear) return target;
  const bool has_zero = config_.floor == 0.0 || config_.ceiling == 0.0;
  return has_zero && std::abs(target) <= 1e-9 * std::abs(target - planned_) ? 0 : target;
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
  planned_ = config_.at_bound == AtBound::clamp ? presented(move.target) : move.target;
}

std::optional<Finish> UpDown::reason_to_finish() const {
  const int n_reversals = static_cast<int>(reversals_.size());
  if (n_reversals >= config_.stop_reversals && n_trials_ >= config_.min_trials)
    return Finish::reversals;
  if (n_trials_ >= config_.stop_trials) return Finish::trials;
  return std::nullopt;
}

}  // namespace heft
