#include "protocol/StaircaseReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Printable.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 1> kinds{"up_down"};

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

void read_steps(TableReader& table, StaircaseConfig& config) {
  table.read("step_scale", config.step_scale);
  const Range steps{0, largest_step(config.step_scale), true};
  table.read("step", config.step, steps);
  table.read("steps", config.steps, steps);
  table.read("steps_up", config.steps_up, steps);
  table.read("halve_every", config.halve_every);
  table.read("min_step", config.min_step, {0, steps.high});
}

void check_steps(TableReader& table, const StaircaseConfig& config) {
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

void check_bounds(TableReader& table, const StaircaseConfig& config) {
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

void check_end(TableReader& table, const StaircaseConfig& config) {
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
}  // namespace

StaircaseConfig read_staircase(TableReader& table) {
  StaircaseConfig config;
  table.require({"name", "start"});
  table.read("name", config.name);
  table.read_name("kind", kinds);
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
  return config;
}

void check_staircase(TableReader& table, const StaircaseConfig& config) {
  check_steps(table, config);
  check_bounds(table, config);
  check_end(table, config);
}

InterleaveConfig read_interleaving(TableReader& table) {
  InterleaveConfig config;
  table.read("interleave", config.interleave);
  table.read("max_lag", config.max_lag);
  return config;
}

void UniqueNames::check(TableReader& table, const std::string& name) {
  if (!table.has("name") || !table.good({"name"})) return;
  const auto [first, is_new] = lines_.try_emplace(name, table.place().line);
  if (!is_new)
    table.mistake("name", fmt::format("there is already a {} named \"{}\" (line {}), expected "
                                      "another name",
                                      what_, printable(name), first->second));
}

}  // namespace heft
