// The quick study of the pipeline makes its files; its chain times every stage.
#include <gtest/gtest.h>

#include <algorithm>

#include "StudyFolder.h"
#include "results/pipeline/Chain.h"
#include "results/tracking/Grips.h"

namespace heft {
namespace {

TEST(PipelineStudy, QuickRunMakesEveryFile) {
  const StudyFolder study("pipeline");
  testing::internal::CaptureStdout();
  run_pipeline_study(study.options());
  EXPECT_NE(testing::internal::GetCapturedStdout().find("whole picture without physics"),
            std::string::npos);
  const auto stages = study.csv("pipeline.csv");
  EXPECT_EQ(stages.rows.size(), 2 * (n_stages + 1));
  for (const char* column : {"median_ms", "p95_ms"})
    for (const double value : stages.numbers(column)) EXPECT_GE(value, 0);
  EXPECT_EQ(stages.numbers("goal_ms"), (std::vector<double>{8, 15}));
  const auto memory = study.csv("memory.csv").numbers("resident_mb");
  ASSERT_EQ(memory.size(), 4U);
  EXPECT_GT(memory.front(), 1);
  EXPECT_TRUE(study.has_chart("pipeline.svg"));
}

TEST(RecordedTrial, LeavesNothingBehind) {
  std::filesystem::path trial_folder;
  {
    const RecordedTrial trial(bench_apparatus(640), 2);
    ASSERT_EQ(trial.files().size(), 2U);
    trial_folder = std::filesystem::path(trial.files()[0]).parent_path();
    EXPECT_TRUE(std::filesystem::exists(trial.files()[1]));
  }
  EXPECT_FALSE(std::filesystem::exists(trial_folder));
}

TEST(Chain, TimesEveryStage) {
  const Apparatus apparatus = bench_apparatus(640);
  const RecordedTrial trial(apparatus, 3);
  Chain chain(apparatus);
  StageTimes most{};
  for (int i = 0; i < 3; ++i) {
    const StageTimes times = chain.run(trial.files()[static_cast<std::size_t>(i)], i / 15.0);
    for (std::size_t s = 0; s < n_stages; ++s) most[s] = std::max(most[s], times[s]);
  }
  for (std::size_t s = 0; s < n_stages; ++s)
    EXPECT_GT(most[s], 0) << EnumNames<PictureStage>::names[s];
}

}  // namespace
}  // namespace heft
