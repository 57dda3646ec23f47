// The adaptive staircases of comparisons with two answers in charts: levels and answers without a
// JND, which they don't estimate.
#include <gmock/gmock.h>

#include <memory>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "analysis/charts/Charts.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;
using testing::Not;

// @param correct none: no cube was named, the answer is "different"
void add_trial(SessionData& data, const std::string& staircase, double level_g,
               std::optional<bool> correct, ComparisonAnswers answers) {
  Attempt& attempt = add_comparison(data, staircase, 200, level_g);
  attempt.trial.plan.condition = "C2";
  attempt.trial.plan.block = name_of(answers);
  attempt.answers_offered = answers;
  attempt.trial.outcome = "difference";
  if (correct) choose(attempt, *correct);
}

template <typename Config>
void declare(SessionData& data, const std::string& staircase, const Config& config) {
  data.without_jnd.insert(staircase);
  data.staircases[staircase] = {std::make_shared<const Procedure>(staircase, config)};
}

SessionData two_answers() {
  SessionData data = session(1, "one");
  UpDownConfig up_down;
  up_down.start = 200;
  up_down.step = 40;
  up_down.stop_trials = 40;
  declare(data, "adaptive", up_down);
  declare(data, "constant", ConstantConfig{.levels = {40, 80}, .n_per_level = 1});
  declare(data, "same or not", up_down);
  for (const bool correct : {true, false})
    for (const char* staircase : {"adaptive", "constant"})
      add_trial(data, staircase, 80, correct, ComparisonAnswers::heavier);
  add_trial(data, "same or not", 80, std::nullopt, ComparisonAnswers::same_different);
  data.attempts.back().trial.choice_correct = false;
  return data;
}

TEST(TwoAnswerTracks, AreOfAdaptiveStaircases) {
  const Summary summary = summarized({two_answers()});
  ASSERT_EQ(summary.all_tracks.size(), 1u);
  const auto& tracks = summary.all_tracks[0].tracks;
  ASSERT_EQ(tracks.size(), 2u) << "constant stimuli have no course";
  EXPECT_EQ(tracks[0].compared.block, "heavier");
  ASSERT_EQ(tracks[0].points.size(), 2u);
  EXPECT_FALSE(tracks[0].points[0].wrong);
  EXPECT_TRUE(tracks[0].points[1].wrong);
  EXPECT_EQ(tracks[1].compared.block, "same_different");
  EXPECT_FALSE(tracks[1].points[0].wrong) << "no cube was chosen";
}

TEST(TwoAnswerTracks, AreChartedWithoutAJnd) {
  const auto charts = charts_of(summarized({two_answers()}));
  const auto named = [&](std::string_view name) {
    const auto found = std::ranges::find(charts, name, &Chart::name);
    EXPECT_NE(found, charts.end()) << name;
    return found == charts.end() ? Chart{"", "", ""} : *found;
  };
  const Chart session = named("staircases");
  EXPECT_THAT(session.script, HasSubstr("'heavier at 200 g, C2'"));
  EXPECT_THAT(session.script, HasSubstr("title 'adaptive'"));
  EXPECT_THAT(session.caption, Not(HasSubstr("JND")));
  EXPECT_THAT(session.caption,
              HasSubstr("Filled: heavier chosen or \"different\"; cross: lighter chosen; open: "
                        "\"same\"; ring: reversal."));
  const Chart forced = named("all_staircases_heavier_200g");
  EXPECT_THAT(forced.script, HasSubstr("filled: heavier chosen; cross: lighter chosen'"));
  EXPECT_THAT(forced.script, HasSubstr("'one'")) << "above the panel, without \"none g\"";
  named("all_staircases_same_different_200g");
}

}  // namespace
}  // namespace heft
