// The procedures of a block's trials: [[block.staircase]].
#include <fmt/format.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/readers/ProtocolTables.h"
#include "tasks/blocks/Staircases.h"

namespace heft {

namespace {
// paired = true: one staircase from `start`, another from `start_below`, otherwise equal.
std::vector<StaircaseSettings> pair_of(TableReader& table, const StaircaseSettings& read,
                                       std::optional<double> start_below) {
  const auto* above = std::get_if<UpDownConfig>(&read.config);
  if (!above) {
    table.mistake("paired", "paired requires up_down staircases, which have a start");
    return {};
  }
  UpDownConfig below = *above;
  if (start_below)
    below.start = *start_below;
  else if (above->floor)
    below.start = *above->floor;
  if (table.good({"start", "start_below", "floor"}) &&
      (below.start >= above->start || (above->floor && below.start < *above->floor)))
    table.mistake(start_below ? "start_below" : "paired",
                  fmt::format("the staircase from below starts at {}, expected below the start {} "
                              "and not below the floor: set start_below",
                              below.start, above->start));
  return {{read.name + " from above", *above}, {read.name + " from below", below}};
}

// Whether the procedure's model is of which stimulus was chosen, and not of yes and no.
template <typename Settings>
bool needs_choice(const Settings& settings) {
  return std::visit(
      [](const auto& config) {
        if constexpr (requires { config.is_indecision(); })
          return config.is_indecision();
        else
          return false;
      },
      settings);
}

const std::vector<double>& values_of(const std::vector<double>& levels) {
  return levels;
}
const std::vector<double>& values_of(const ValueGrid& levels) {
  return levels.values;
}

// Settings that do not suit levels that are masses of a single cube.
template <typename Config>
ConfigMistakes mistakes_in_masses(const Config& config) {
  constexpr auto expected = "above 0: the level is the mass of the cube";
  ConfigMistakes mistakes;
  const auto check = [&](std::string_view key, double value, std::optional<std::size_t> index) {
    if (value <= 0)
      mistakes.push_back({{key}, fmt::format("{} has {}", key, value), expected, index});
  };
  bool has_limit = false;
  if constexpr (requires { config.levels; }) {
    has_limit = true;
    for (std::size_t i = 0; i < values_of(config.levels).size(); ++i)
      check("levels", values_of(config.levels)[i], i);
  }
  if constexpr (requires { config.step_scale; })
    has_limit = has_limit || config.step_scale != StepScale::linear;
  if constexpr (requires { *config.floor; }) {
    if (!config.floor && !has_limit) mistakes.push_back({{"floor"}, "lacks \"floor\"", expected});
    if (config.floor && !has_limit) check("floor", *config.floor, std::nullopt);
  }
  if constexpr (requires { config.scale; })
    if (config.scale != LevelScale::linear)
      mistakes.push_back({{"scale"},
                          fmt::format("scale is \"{}\"", name_of(config.scale)),
                          "\"linear\": levels are in g"});
  if constexpr (requires { *config.start; })
    if (config.start) check("start", *config.start, std::nullopt);
  return mistakes;
}
}  // namespace

std::vector<ReferenceStaircase> read_staircases_of(TableReader& table,
                                                   const TechniqueNames& techniques,
                                                   UniqueNames& names,
                                                   const StaircaseRules& rules) {
  using Reference = StaircaseRules::Reference;
  const bool is_object = rules.object_g || rules.reference == Reference::unknown;
  double reference_g = 0;
  std::string condition;
  bool paired = false;
  std::optional<double> start_below;
  if (rules.reference == Reference::required && !is_object) table.require({"reference_g"});
  table.read("reference_g", reference_g, above_zero);
  if (is_object && table.has("reference_g"))
    table.mistake("reference_g",
                  "reference_g together with the block's reference, expected without: it is the "
                  "mass of the real object");
  reference_g = rules.object_g.value_or(reference_g);
  techniques.read(table, condition);
  table.read("paired", paired);
  table.read("start_below", start_below, zero_or_more);
  if (start_below && !paired)
    table.mistake("start_below",
                  "start_below requires paired = true, which makes a second "
                  "staircase that starts there");
  const auto settings = read_staircase(table);
  if (!settings) return {{reference_g, StaircaseSettings{}.procedure(), condition}};
  if (rules.object_g || (table.has("reference_g") && table.good({"reference_g"})))
    check_beside(table, *settings, reference_g, rules.either_sign);
  if (!table.has("reference_g") && rules.reference == Reference::optional)
    table.note(std::visit([](const auto& config) { return mistakes_in_masses(config); },
                          settings->config));
  if (!rules.no_cube.empty() && needs_choice(settings->config))
    table.mistake("function", fmt::format("function is \"indecision\" with {}, expected another: "
                                          "this one needs to know which cube is heavier",
                                          rules.no_cube));
  std::vector<ReferenceStaircase> staircases;
  for (const StaircaseSettings& one :
       paired ? pair_of(table, *settings, start_below) : std::vector{*settings}) {
    names.check(table, one.name);
    staircases.push_back({reference_g, one.procedure(), condition});
  }
  return staircases;
}

}  // namespace heft
