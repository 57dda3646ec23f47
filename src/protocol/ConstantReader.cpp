// The keys of kind "constant".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "protocol/KindReaders.h"

namespace heft {

namespace {
constexpr std::size_t most_constant_trials = 10'000;  // beyond any session
}

void read_keys(TableReader& table, ConstantConfig& config) {
  table.require({"levels", "n_per_level"});
  table.read("levels", config.levels);
  table.read("n_per_level", config.n_per_level, {1});
  table.read("order", config.order);
}

void check_keys(TableReader& table, const ConstantConfig& config) {
  if (!table.good({"levels"})) return;
  const std::span levels(config.levels);
  const std::size_t n_trials = levels.size() * static_cast<std::size_t>(config.n_per_level);
  if (n_trials > most_constant_trials)
    return table.mistake(
        table.has("n_per_level") ? "n_per_level" : "levels",
        fmt::format("{} levels, each {} times, make {} trials, expected at most "
                    "{} in all",
                    levels.size(), config.n_per_level, n_trials, most_constant_trials));
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (std::ranges::count(levels.first(i), levels[i]) > 0)
      table.mistake("levels", i,
                    fmt::format("levels has {} twice, expected different levels: n_per_level says "
                                "how often each comes",
                                levels[i]));
}

void check_lightest(TableReader& table, const ConstantConfig& config, double reference_g) {
  if (!table.has("levels") || !table.good({"levels"})) return;
  for (std::size_t i = 0; i < config.levels.size(); ++i)
    if (config.levels[i] <= -reference_g)
      table.mistake("levels", i,
                    fmt::format("levels has {}: beside a reference of {} g the comparison would "
                                "weigh 0 g or less, expected above {}",
                                config.levels[i], reference_g, -reference_g));
}

std::string described(const ConstantConfig& config) {
  return fmt::format("constant levels {} g, each {} times, {}", fmt::join(config.levels, ", "),
                     config.n_per_level,
                     config.order == ConstantOrder::blocks ? "in blocks" : "shuffled");
}

}  // namespace heft
