// How long answers took, by task and condition, over the trials of a session, and why attempts are
// void.
#include <fmt/format.h>

#include "analysis/Section.h"
#include "analysis/Timing.h"

namespace heft {

namespace {
constexpr Measure response_time{
    "response_time", "s", "response time",
    "median with quartiles as low and high, from all cubes shown to the "
    "answer, without pauses and time with the effector out of view"};
constexpr Measure time_by_trial{"response_time_by_trial", "s", "response time",
                                "the same over tenths of each session's trials of a task"};
constexpr Measure n_void{"void_attempts", "", "void attempts",
                         "attempts at trials that do not count and were presented again"};

constexpr int n_tenths = 10;

class TimingSection final : public Section {
 public:
  void add(const SessionData& data) override {
    times_.add(data);
    voids_.add(data);
    add_tenths(data);
  }

  void put(Summary& summary) override {
    for (const ResponseTimes& times : times_.result()) {
      StudyEstimate estimate{&response_time, times.task, times.condition};
      estimate.value = times.median_s;
      estimate.low = times.lower_quartile_s;
      estimate.high = times.upper_quartile_s;
      estimate.n = summary.n_participants;
      estimate.n_trials = times.n_trials;
      estimate.method = "quartiles";
      summary.estimates.push_back(std::move(estimate));
    }
    for (const auto& [task, times] : by_task_)
      for (const auto& [tenth, values] : times.tenths_s) {
        StudyEstimate estimate = quartiles_estimate(time_by_trial, values);
        estimate.task = task;
        estimate.condition = fmt::format("{}", fmt::join(times.conditions, ", "));
        estimate.n = summary.n_participants;
        estimate.by = {at("percent_of_trials", 100.0 * (tenth + 0.5) / n_tenths)};
        summary.estimates.push_back(std::move(estimate));
      }
    for (const VoidCount& reason : voids_.result()) {
      StudyEstimate estimate{&n_void};
      estimate.by = {{"reason", reason.reason}};
      estimate.value = reason.n;
      summary.estimates.push_back(std::move(estimate));
    }
    times_ = {};
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
                            key_column("percent_of_trials", "% of the trials"),
                            column(time_by_trial, Field::n_trials, "n", "n"),
                            column(time_by_trial, Field::value, "median_s", "median", 2),
                            column(time_by_trial, Field::low, "lower_quartile_s", "25 %", 2),
                            column(time_by_trial, Field::high, "upper_quartile_s", "75 %", 2)},
                           "",
                           TablePlace::csv};
    EstimateTable voids{"voids",
                        "Void attempts (each was presented again)",
                        {key_column("reason", "reason"), column(n_void, Field::value, "n", "n", 0)},
                        "",
                        TablePlace::run,
                        "voids[]"};
    return {times, by_trial, voids};
  }

  std::vector<ChartSpec> charts() const override {
    ChartSpec chart{"times_by_trial", "Response time over the trials",
                    "From all cubes shown to the answer, without pauses and time out of view: "
                    "median and quartiles by task, over tenths of each session's trials of it.",
                    "times_by_trial.csv", ChartShape::lines};
    chart.importance = 85;
    chart.series = {{&time_by_trial, "", {}}};
    chart.x = "percent_of_trials";
    chart.split = {"task", "condition"};
    chart.x_label = "% of the trials of a session";
    chart.y_label = "response time (s)";
    chart.axes = "set yrange [0:*]\n";
    return {chart};
  }

 private:
  struct Times {
    std::set<std::string> conditions;
    std::map<int, std::deque<double>> tenths_s;
  };

  void add_tenths(const SessionData& data) {
    std::map<Task, std::vector<const Attempt*>, InTaskOrder> by_task;
    for (const Attempt& attempt : data.attempts)
      if (attempt.completed() && attempt.trial.plan.task != "introduction")
        by_task[attempt.trial.plan.task].push_back(&attempt);
    for (const auto& [task, attempts] : by_task)
      for (std::size_t i = 0; i < attempts.size(); ++i) {
        Times& times = by_task_[task];
        times.conditions.insert(attempts[i]->trial.plan.condition);
        if (const auto time_s = response_time_s(attempts[i]->trial))
          times.tenths_s[static_cast<int>(n_tenths * i / attempts.size())].push_back(*time_s);
      }
  }

  TimesFold times_;
  VoidsFold voids_;
  std::map<Task, Times, InTaskOrder> by_task_;
};
}  // namespace

std::shared_ptr<Section> timing_section() {
  return std::make_shared<TimingSection>();
}

}  // namespace heft
