#include "psychophysics/Constant.h"

#include <fmt/format.h>

#include <cassert>
#include <set>
#include <span>

namespace heft {

ConfigMistakes ConstantConfig::check() const {
  constexpr std::size_t most_trials = 10'000;  // more than any session
  ConfigMistakes mistakes = out_of_range(*this);
  if (n_per_level < 1) return mistakes;
  const std::size_t n_trials = levels.size() * static_cast<std::size_t>(n_per_level);
  if (n_trials > most_trials) {
    mistakes.push_back({{"n_per_level", "levels"},
                        fmt::format("{} levels, each {} times, make {} trials", levels.size(),
                                    n_per_level, n_trials),
                        fmt::format("at most {} in all", most_trials)});
    return mistakes;
  }
  std::set<double> before;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (!before.insert(levels[i]).second)
      mistakes.push_back({{"levels"},
                          fmt::format("levels has {} twice", levels[i]),
                          "different levels; n_per_level sets how often each is presented",
                          i});
  return mistakes;
}

ConfigMistakes ConstantConfig::check_beside(double reference, bool) const {
  ConfigMistakes mistakes;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (levels[i] <= -reference)
      mistakes.push_back(
          {{"levels"},
           fmt::format("levels has {}: with a reference of {} g the comparison would weigh 0 g "
                       "or less",
                       levels[i], reference),
           fmt::format("above {}", -reference),
           i});
  return mistakes;
}

std::vector<double> constant_schedule(const ConstantConfig& config, RandomStream stream) {
  std::vector<double> schedule;
  for (int round = 0; round < config.n_per_level; ++round)
    schedule.insert(schedule.end(), config.levels.begin(), config.levels.end());
  const std::size_t n_shuffled =
      config.order == ConstantOrder::blocks ? config.levels.size() : schedule.size();
  for (std::size_t i = 0; i < schedule.size(); i += n_shuffled)
    stream.shuffle(std::span(schedule).subspan(i, n_shuffled));
  return schedule;
}

double Constant::next_level(const RandomStream& stream) const {
  assert(!finish());
  return constant_schedule(config_, stream).at(static_cast<std::size_t>(n_trials_));
}

Update Constant::respond(const Response&, double) {
  assert(!finish());
  ++n_trials_;
  return {std::nullopt, finish()};
}

std::optional<StopReason> Constant::finish() const {
  return n_trials_ < planned_trials() ? std::nullopt : std::optional(StopReason::trials);
}

std::vector<Estimate> Constant::estimates() const {
  return {{.method = std::string(ConstantConfig::kind), .n_trials = n_trials_}};
}

std::optional<int> Constant::planned_trials() const {
  return config_.n_per_level * static_cast<int>(config_.levels.size());
}

}  // namespace heft
