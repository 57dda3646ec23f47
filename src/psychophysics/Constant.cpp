#include "psychophysics/Constant.h"

#include <cassert>
#include <span>

namespace heft {

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

std::optional<Finish> Constant::finish() const {
  return n_trials_ < planned_trials() ? std::nullopt : std::optional(Finish::trials);
}

std::vector<Estimate> Constant::estimates() const {
  return {{.method = std::string(ConstantConfig::kind), .n_trials = n_trials_}};
}

std::optional<int> Constant::planned_trials() const {
  return config_.n_per_level * static_cast<int>(config_.levels.size());
}

}  // namespace heft
