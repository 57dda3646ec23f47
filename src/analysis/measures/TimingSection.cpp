// Response times by task, condition and position in the session, and reasons of void attempts.
#include <fmt/format.h>

#include <functional>
#include <set>

#include "analysis/measures/Section.h"
#include "tasks/Task.h"

namespace heft {

namespace {
constexpr Measure response_time{
    "response_time", "s", "response time",
    "median with quartiles as low and high, from all cubes shown to the "
    "answer, without pauses and time with the effector out of view"};
constexpr Measure time_by_trial{
    "response_time_by_trial", "s", "response time",
    "median response time by tenths of each session's trials of a task"};
constexpr Measure n_void{"void_attempts", "", "void attempts",
                         "attempts that were discarded and presented again"};

constexpr int n_tenths = 10;

class TimingSection final : public Section {
 public:
  void add(const SessionData& data) override {
    std::map<Task, std::vector<const TrialRow*>, InTaskOrder> by_task;
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (trial.status == TrialStatus::voided)
        n_void_[trial.void_reason.value_or("no reason logged")] += 1;
      if (!attempt.completed()) continue;
      std::deque<double>& times_s = times_s_[{trial.plan.task, trial.plan.condition}];
      if (const auto time_s = response_time_s(trial)) times_s.push_back(*time_s);
      if (trial.plan.task != "introduction") by_task[trial.plan.task].push_back(&trial);
    }
    for (const auto& [task, trials] : by_task)
      for (std::size_t i = 0; i < trials.size(); ++i) {
        Times& times = by_task_[task];
        times.conditions.insert(trials[i]->plan.condition);
        if (const auto time_s = response_time_s(*trials[i]))
          times.tenths_s[static_cast<int>(n_tenths * i / trials.size())].push_back(*time_s);
      }
  }

  void put(Summary& summary) override {
    const auto put = [&](StudyEstimate estimate, const Task& task, std::string condition) {
      estimate.task = task;
      estimate.condition = std::move(condition);
      estimate.n = summary.n_participants;
      summary.estimates.push_back(std::move(estimate));
    };
    for (const auto& [of, times_s] : times_s_)
      put(quartiles_estimate(response_time, times_s), of.first, of.second);
    for (const auto& [task, times] : by_task_)
      for (const auto& [tenth, times_s] : times.tenths_s) {
        StudyEstimate estimate = quartiles_estimate(time_by_trial, times_s);
        estimate.by = {at("percent_of_trials", 100.0 * (tenth + 0.5) / n_tenths)};
        put(std::move(estimate), task, fmt::format("{}", fmt::join(times.conditions, ", ")));
      }
    std::vector<std::pair<std::string, int>> reasons(n_void_.begin(), n_void_.end());
    std::ranges::stable_sort(reasons, std::greater(), &std::pair<std::string, int>::second);
    for (const auto& [reason, n] : reasons) {
      StudyEstimate& estimate = summary.estimates.emplace_back(StudyEstimate{&n_void});
      estimate.by = {{"reason", reason}};
      estimate.value = n;
    }
    times_s_.clear();
    by_task_.clear();
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable times{"response_times",
                        "Response times, all participants together",
                        {key_column("task", "task"), key_column("condition", "condition"),
                         column(response_time, Field::n_trials, "n_trials", "trials"),
                         column(response_time, Field::value, "median_s", "median s"),
                         column(response_time, Field::low, "lower_quartile_s", "25 %"),
                         column(response_time, Field::high, "upper_quartile_s", "75 %")},
                        "from all cubes shown to the answer, without pauses and time with the "
                        "effector out of view",
                        TablePlace::run,
                        "response_times[]"};
    EstimateTable by_trial{"times_by_trial",
                           "Response times over the trials",
                           {key_column("task", "task"), key_column("condition", "conditions"),
                            key_column("percent_of_trials", "% of the trials")},
                           "",
                           TablePlace::csv};
    add_quartiles(by_trial.columns, time_by_trial);
    EstimateTable voids{"voids",
                        "Void attempts (each was presented again)",
                        {key_column("reason", "reason"), column(n_void, Field::value, "n", "n", 0)},
                        "",
                        TablePlace::run,
                        "voids[]"};
    return {times, by_trial, voids};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "times_by_trial",
             .title = "Response time over the trials",
             .caption = "From all cubes shown to the answer, without pauses and time out of view: "
                        "median and quartiles by task, over tenths of each session's trials of it.",
             .csv = "times_by_trial.csv",
             .shape = ChartShape::lines,
             .importance = 85,
             .series = {{&time_by_trial}},
             .x = "percent_of_trials",
             .split = {"task", "condition"},
             .x_label = "% of the trials of a session",
             .y_label = "response time (s)",
             .axes = "set yrange [0:*]\n"}};
  }

 private:
  struct Times {
    std::set<std::string> conditions;
    std::map<int, std::deque<double>> tenths_s;
  };

  std::map<std::pair<Task, std::string>, std::deque<double>, InTaskOrder> times_s_;
  std::map<Task, Times, InTaskOrder> by_task_;
  std::map<std::string, int> n_void_;
};
}  // namespace

std::shared_ptr<Section> timing_section() {
  return std::make_shared<TimingSection>();
}

}  // namespace heft
