// The keys of kind "up_down".
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/Printable.h"
#include "protocol/KindReaders.h"

namespace heft {

namespace {
// Ten decades at once leave every scale of masses.
double largest_step(StepScale scale) {
  switch (scale) {
    case StepScale::linear:
      return furthest;
    case StepScale::db:
      return 200;
    case StepScale::log10:
      return 10;
  }
  return furthest;
}

void read_steps(TableReader& table, UpDownConfig& config) {
  table.read("step_scale", config.step_scale);
  const Range steps{0, largest_step(config.step_scale), true};
  table.read("step", config.step, steps);
  table.read("steps", config.steps, steps);
  table.read("steps_up", config.steps_up, steps);
  table.read("halve_every", config.halve_every);
  table.read("min_step", config.min_step, {0, steps.high});
}

void check_steps(TableReader& table, const UpDownConfig& config) {
  if (!table.has("step") && !table.has("steps")) {
    if (table.good({"step", "steps"}))
      table.mistake("step", table.title() + " lacks \"step\" or \"steps\"");
    return;
  }
  if (table.has("steps")) {
    for (std::string_view key : {"step", "halve_every", "min_step"})
      if (table.has(key))
        table.mistake(key, fmt::format("{} together with steps, expected only one of them: the "
                                       "list says every step",
                                       key));
  } else if (table.good({"step", "min_step"}) && config.min_step > config.step) {
    table.mistake("min_step", fmt::format("min_step is {}, expected at most the step {}",
                                          config.min_step, config.step));
  }
}

void check_bounds(TableReader& table, const UpDownConfig& config) {
  const auto& [floor, ceiling] = std::tie(config.floor, config.ceiling);
  if (table.good({"floor", "ceiling"}) && floor && ceiling && *floor >= *ceiling)
    return table.mistake(
        "floor", fmt::format("floor is {}, expected below the ceiling {}", *floor, *ceiling));
  if (!table.good({"start"}) || !table.has("start")) return;
  if (table.good({"floor"}) && floor && config.start < *floor)
    table.mistake("start",
                  fmt::format("start is {}, expected at least the floor {}", config.start, *floor));
  if (table.good({"ceiling"}) && ceiling && config.start > *ceiling)
    table.mistake("start", fmt::format("start is {}, expected at most the ceiling {}", config.start,
                                       *ceiling));
}

void check_end(TableReader& table, const UpDownConfig& config) {
  if (table.good({"discard_reversals", "stop_reversals"}) &&
      config.discard_reversals >= config.stop_reversals)
    table.mistake(table.has("discard_reversals") ? "discard_reversals" : "stop_reversals",
                  fmt::format("discard_reversals is {} and stop_reversals {}: no reversal is left "
                              "for the estimate, expected fewer to discard",
                              config.discard_reversals, config.stop_reversals));
  if (table.good({"min_trials", "stop_trials"}) && config.min_trials > config.stop_trials)
    table.mistake("min_trials", fmt::format("min_trials is {}, expected at most stop_trials {}",
                                            config.min_trials, config.stop_trials));
}

std::string bound_text(const std::optional<double>& bound_g) {
  return bound_g ? fmt::format("{:g} g", *bound_g) : "none";
}
}  // namespace

void read_keys(TableReader& table, UpDownConfig& config) {
  table.require({"start"});
  read_steps(table, config);
  const bool ratio = config.step_scale != StepScale::linear;
  const Range levels = ratio ? zero_or_more : any_number;
  table.read("start", config.start, ratio ? above_zero : any_number);
  table.read("floor", config.floor, levels);
  table.read("ceiling", config.ceiling, levels);
  table.read("up", config.up, {1});
  table.read("down", config.down, {1});
  table.read("initial_1up1down", config.initial_1up1down);
  table.read("at_bound", config.at_bound);
  table.read("bound_is_reversal", config.bound_is_reversal);
  table.read("change_step", config.change_step);
  table.read("stop_reversals", config.stop_reversals, {1});
  table.read("min_trials", config.min_trials);
  table.read("stop_trials", config.stop_trials, {1});
  table.read("discard_reversals", config.discard_reversals);
}

void check_keys(TableReader& table, const UpDownConfig& config) {
  check_steps(table, config);
  check_bounds(table, config);
  check_end(table, config);
}

void check_lightest(TableReader& table, const UpDownConfig& config, double reference_g) {
  if (!table.good({"floor", "step_scale"})) return;
  // "Heavier" or "no difference" says of a lighter comparison the opposite of what it says of a
  // heavier one, so a staircase that got below 0 would run away.
  if (config.step_scale == StepScale::linear && !config.floor)
    table.mistake("floor", fmt::format("{} lacks \"floor\": its linear steps could make the "
                                       "comparison lighter than the reference, expected a floor of "
                                       "0 or more",
                                       table.title()));
  if (config.floor && *config.floor < 0)
    table.mistake("floor", fmt::format("floor is {}: beside a reference of {} g the comparison "
                                       "could get the lighter one, for which this staircase's "
                                       "answers mean the opposite, expected 0 or more",
                                       *config.floor, reference_g));
}

std::string described(const UpDownConfig& config) {
  return fmt::format("floor {}, ceiling {}, step changes {}, at most {} trials",
                     bound_text(config.floor), bound_text(config.ceiling),
                     name_of(config.change_step), config.stop_trials);
}

}  // namespace heft
