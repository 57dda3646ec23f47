// Display of logged frames.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "replay/Replay.h"
#include "replay/StoredSession.h"
#include "view/scene/SceneDrawing.h"

namespace heft {
namespace {
using ::testing::HasSubstr;
using testing::shipped_protocol;
using testing::StoredSession;

class Onlooker final : public ArView {
 public:
  std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) override {
    pictures.push_back(shown);
    only_trials = only_trials && screen.screen == Screen::trial;
    return {};
  }
  std::vector<Touch> wait(double) override { return {}; }

  std::vector<ViewFrame> pictures;
  bool only_trials = true;
};

TEST(ReplayViewOptions, EveryFrameAsItWasLogged) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 5);
  Onlooker view;
  const int n = show_session(stored.reader(), stored.session(), view, {});
  std::vector<FrameRow> rows;
  for (const TrialRow& trial : stored.reader().trials(stored.id()))
    for (const FrameRow& row : stored.reader().frames(stored.id(), trial.attempt_index))
      rows.push_back(row);
  ASSERT_EQ(n, static_cast<int>(rows.size()));
  ASSERT_EQ(view.pictures.size(), rows.size());
  EXPECT_TRUE(view.only_trials);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DisplayedFrame& frame = view.pictures[i].frame;
    EXPECT_EQ(frame.effector.position_m, rows[i].effector.position_m);
    ASSERT_EQ(frame.cubes.size(), rows[i].cubes.size());
    EXPECT_FALSE(view.pictures[i].other_clone);
  }
}

TEST(ReplayViewOptions, EachFrameSaysItsTrialMassesTimeAndAnswers) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 5);
  Onlooker view;
  show_session(stored.reader(), stored.session(), view, {});
  std::size_t n = 0;
  for (const TrialRow& trial : stored.reader().trials(stored.id())) {
    const auto frames = stored.reader().frames(stored.id(), trial.attempt_index);
    ASSERT_FALSE(frames.empty());
    const auto& first = view.pictures.at(n).captions;
    n += frames.size();
    const auto& last = view.pictures.at(n - 1).captions;
    ASSERT_EQ(first.size(), std::size_t{replay_captions});
    EXPECT_THAT(first[0], HasSubstr(fmt::format("trial {}: {}, {}; left to right {:g}",
                                                trial.plan.trial_number, trial.plan.task,
                                                trial.plan.condition, trial.plan.masses_g[0])));
    EXPECT_THAT(first[0], HasSubstr(" g; 0.0 s"));
    EXPECT_EQ(first[1], "answer: none yet");
    ASSERT_TRUE(trial.outcome);
    EXPECT_THAT(last[1], HasSubstr(" (" + *trial.outcome + ")"));
    EXPECT_THAT(last[2], HasSubstr("blue: clone"));
  }
  EXPECT_EQ(n, view.pictures.size());
}

TEST(ReplayViewOptions, AWhatIfsCloneStandsBesideTheLoggedOne) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 5);
  const auto header = stored.session().row.header;
  const Protocol stiffer =
      parse_protocol(header.protocol_text, header.protocol_name,
                     std::vector<ProtocolSetting>{{"coupling.stiffness_n_per_m", "200"}});
  Onlooker same, other;
  show_session(stored.reader(), stored.session(), same, {stored.session().protocol.get()});
  show_session(stored.reader(), stored.session(), other, {&stiffer});
  double largest_m = 0;
  const ViewFrame* farthest = nullptr;
  for (std::size_t i = 0; i < same.pictures.size(); ++i) {
    ASSERT_TRUE(same.pictures[i].other_clone);
    EXPECT_EQ(same.pictures[i].other_clone->position_m, same.pictures[i].frame.clone->position_m);
    const double apart_m =
        (other.pictures[i].other_clone->position_m - other.pictures[i].frame.clone->position_m)
            .norm();
    if (apart_m > largest_m) {
      largest_m = apart_m;
      farthest = &other.pictures[i];
    }
  }
  ASSERT_GT(largest_m, 0.02);
  ViewSetup setup;
  setup.stage = stage_of(stiffer, 3);
  SceneDrawing drawing(setup);
  ViewFrame alone = *farthest;
  alone.other_clone.reset();
  const Image without = drawing.draw(alone);
  EXPECT_NE(drawing.draw(*farthest).pixels, without.pixels);
}

}  // namespace
}  // namespace heft
