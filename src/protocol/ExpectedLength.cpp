#include "protocol/ExpectedLength.h"

#include <utility>

#include "tasks/Tasks.h"

namespace heft {

namespace {
class Forecast {
 public:
  Forecast(TrialDurations durations, double gap_s)
      : durations_(std::move(durations)), gap_s_(gap_s) {}

  void operator()(const DemonstrationBlock& block) { seconds_ += block.duration_s; }
  void operator()(const BreakBlock& block) { seconds_ += block.least_duration_s; }
  void operator()(const TaskBlock& block) {
    Tasks::call(block.task().name, [&]<typename Kind>() {
      add_trials(block.as<typename Kind::Block>()->expected_trials(),
                 durations_.at(std::string(Kind::task.name)));
    });
    if (const auto* comparison = block.as<Comparison::Block>()) {
      length_.staircase_trials += comparison->expected_staircase_trials();
      length_.staircases += static_cast<int>(comparison->staircases.size());
    }
  }

  ExpectedLength length() const {
    ExpectedLength length = length_;
    length.minutes = seconds_ / 60;
    return length;
  }

 private:
  void add_trials(double trials, double seconds_each) {
    length_.trials += trials;
    seconds_ += trials * (seconds_each + gap_s_);
  }

  TrialDurations durations_;
  double gap_s_;
  ExpectedLength length_;
  double seconds_ = 0;
};
}  // namespace

TrialDurations assumed_durations() {
  TrialDurations durations;
  Tasks::each([&]<typename Kind>() {
    durations.emplace(std::string(Kind::task.name), Kind::assumed_trial_s);
  });
  return durations;
}

ExpectedLength expected_length(const Protocol& protocol, const TrialDurations& durations) {
  Forecast forecast(durations, protocol.onset.gap_s);
  for (const Block& block : protocol.blocks) std::visit(forecast, block);
  return forecast.length();
}

}  // namespace heft
