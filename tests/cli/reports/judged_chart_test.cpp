// heft replay --responder --chart: any name of a technique or model can be drawn.
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/reports/Reports.h"
#include "record/temporary_folder.h"

namespace heft::cli {
namespace {

// They come from protocols and logs of anybody.
TEST(JudgedChart, NamesAreNoCommandsOfGnuplot) {
  const test::TemporaryFolder folder;
  const std::string harm = folder.file("harm"), chart = folder.file("chart.svg");
  JudgedLog log;
  log.repeats = 1;
  int number = 0;
  for (const char* format :
       {"x`touch {0}`", "x\" 0); system('touch {0}') #", "x' 0); system('touch {0}') #",
        "x\nsystem('touch {0}')\n#", "x'.system('touch {0}').'", "x\\"}) {
    const std::string name = fmt::format(fmt::runtime(format), harm);
    log.names = {name, "simulated"};
    JudgedTrial trial;
    trial.person = name;
    trial.trial_number = ++number;
    trial.task = Task("comparison");
    trial.condition = name;
    trial.reference_g = 200;
    trial.level_g = 300;
    trial.n_answers = 3;
    trial.answer = "comparison";
    AnswerDraws draws;
    for (const char* answer : {"comparison", "none", "comparison"}) draws.add(answer, {});
    trial.models = {draws, draws};
    log.judgments.trials.push_back(trial);
  }
  draw_judged(log, chart);
  EXPECT_TRUE(std::filesystem::exists(chart));
  EXPECT_FALSE(std::filesystem::exists(harm));
}

}  // namespace
}  // namespace heft::cli
