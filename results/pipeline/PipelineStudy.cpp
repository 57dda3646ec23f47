#include <unistd.h>

#include <fstream>
#include <numeric>

#include "base/math/Quantiles.h"
#include "results/Study.h"
#include "results/pipeline/Chain.h"
#include "results/tracking/TrackingStudy.h"
#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {

namespace {
constexpr int pictures_per_trial = 150;
constexpr int pictures_per_hour = 54000, pictures_per_row = 900;  // 15 a second; a minute

double in_trial_s(int picture, const RecordedTrial& trial) {
  return picture % static_cast<int>(trial.files().size()) / RecordedTrial::rate_hz;
}

StageTimes run_one(Chain& chain, const RecordedTrial& trial, int picture) {
  const auto in_trial = static_cast<std::size_t>(picture) % trial.files().size();
  if (in_trial == 0) chain.begin_trial();
  return chain.run(trial.files()[in_trial], in_trial_s(picture, trial));
}

double without_physics(const StageTimes& times) {
  return std::accumulate(times.begin(), times.end(), 0.0) -
         times[static_cast<std::size_t>(PictureStage::physics)];
}

BudgetLine line_of(std::string stage, const std::vector<double>& times_ms) {
  return {std::move(stage), quantile(times_ms, 0.5).value_or(0),
          quantile(times_ms, 0.95).value_or(0)};
}

Budget measure_budget(int width_px, bool quick) {
  const Apparatus apparatus = bench_apparatus(width_px);
  const int n = quick ? 30 : pictures_per_trial;
  const RecordedTrial trial(apparatus, n);
  Chain chain(apparatus);
  std::vector<StageTimes> all;
  for (int i = 0; i < (quick ? n : 2 * n); ++i) all.push_back(run_one(chain, trial, i));
  Budget budget{width_px, {}, {}, static_cast<int>(all.size())};
  for (std::size_t stage = 0; stage < n_stages; ++stage) {
    std::vector<double> times_ms;
    for (const StageTimes& times : all) times_ms.push_back(times[stage]);
    budget.stages.push_back(line_of(std::string(EnumNames<PictureStage>::names[stage]), times_ms));
  }
  std::vector<double> sums_ms;
  for (const StageTimes& times : all) sums_ms.push_back(without_physics(times));
  budget.whole = line_of("whole picture without physics", sums_ms);
  return budget;
}

void write(const std::vector<Budget>& budgets, const StudyOptions& options) {
  CsvFile csv(options, "pipeline.csv", "picture,stage,median_ms,p95_ms,goal_ms,pictures");
  for (const Budget& budget : budgets) {
    for (const BudgetLine& line : budget.stages)
      csv.row(size_name(budget.width_px), line.stage, line.median_ms, line.p95_ms, "",
              budget.n_pictures);
    csv.row(size_name(budget.width_px), budget.whole.stage, budget.whole.median_ms,
            budget.whole.p95_ms, budget.goal_ms(), budget.n_pictures);
  }
}

void print(const std::vector<Budget>& budgets) {
  for (const Budget& budget : budgets) {
    fmt::print("{:<32}{:>14}{:>10}\n", size_name(budget.width_px), "median ms", "p95 ms");
    for (const BudgetLine& line : budget.stages)
      fmt::print("  {:<30}{:>14.3f}{:>10.3f}\n", line.stage, line.median_ms, line.p95_ms);
    fmt::print("  {:<30}{:>14.3f}{:>10.3f}   goal {:g}{}\n", budget.whole.stage,
               budget.whole.median_ms, budget.whole.p95_ms, budget.goal_ms(),
               budget.whole.median_ms <= budget.goal_ms() ? "" : "  MISSED");
  }
}

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double total_pages = 0, resident_pages = 0;
  file >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// The whole chain again and again, trial after trial, for an hour's pictures.
void study_memory(const StudyOptions& options, StudyProgress& progress) {
  const Apparatus apparatus = bench_apparatus(640);
  const int n = options.quick ? 60 : pictures_per_hour;
  const int every = options.quick ? 15 : pictures_per_row;
  const RecordedTrial trial(apparatus, options.quick ? 15 : pictures_per_trial);
  Chain chain(apparatus);
  CsvFile csv(options, "memory.csv", "pictures,session_min,resident_mb");
  std::vector<double> resident;
  for (int i = 0; i < n; ++i) {
    if (i % every == 0) progress.next(fmt::format("memory, picture {} of {}", i, n));
    run_one(chain, trial, i);
    if ((i + 1) % every != 0) continue;
    resident.push_back(resident_mb());
    csv.row(i + 1, (i + 1) / RecordedTrial::rate_hz / 60, resident.back());
  }
  fmt::print("memory: {:.1f} MB after {} pictures, {:.1f} MB after {}\n", resident.front(), every,
             resident.back(), n);
}
}  // namespace

void run_pipeline_study(const StudyOptions& options) {
  keep_opencv_on_one_thread();
  const int n_memory = options.quick ? 4 : pictures_per_hour / pictures_per_row;
  StudyProgress progress(static_cast<int>(picture_widths_px.size()) + n_memory);
  std::vector<Budget> budgets;
  for (const int width_px : picture_widths_px) {
    progress.next("stages at " + size_name(width_px));
    budgets.push_back(measure_budget(width_px, options.quick));
  }
  write(budgets, options);
  draw(options, "pipeline", pipeline_chart(budgets, options));
  print(budgets);
  study_memory(options, progress);
}

}  // namespace heft
