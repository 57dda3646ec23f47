// Fifty trials of each task by taps anywhere on the buttons: the log has the intended actions and
// no others, in four languages, of which one reads from right to left, and in every window size.
// Judgments: tests/session/answer_taps_test.cpp; adjustments and real references: beside this file.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>

#include "base/Random.h"
#include "session/TappedSession.h"
#include "tasks/Tasks.h"
#include "view/screens/TouchScreen.h"

namespace heft {
namespace {

using testing::made_up_s;
using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;
using testing::TappedSetting;

constexpr int n_trials = 50;
/// Longer than earlier answers, and second taps on a button, are ignored.
constexpr double unhurried_s = settle_s + 0.05;
static_assert(unhurried_s > testing::min_answer_s);

/// A button, and the action that it gives; empty: none yet.
struct Step {
  std::string control, action{};
  double along = -1;  ///< of the button's width; below 0: anywhere
};
using Steps = std::vector<Step>;

std::string text_of(const Action& action) {
  std::string text(action.kind);
  if (action.slot) text += fmt::format(" {}", *action.slot);
  if (action.label) text += fmt::format(" {}", *action.label);
  if (action.value) text += fmt::format(" {:g}", *action.value);
  return text;
}

/// Taps the steps of a random answer of each trial, once each.
class Tapper {
 public:
  using Answering = std::function<Steps(const ScreenState& state, RandomStream& random)>;

  Tapper(std::uint64_t seed, Answering answering)
      : random_(seed, "tapper"), answering_(std::move(answering)) {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.screen != Screen::trial) return testing::tap_on(testing::onwards(screen), random_);
    if (made_up_s > begun_s_ + 2000)
      throw std::runtime_error(fmt::format("trial {} takes no answer", state.trial_number));
    if (state.faded || !state.can_answer) return std::nullopt;
    if (const auto answer = next_answer(state)) begin(state, *answer);
    if (next_ == steps_.size()) return std::nullopt;
    const Step& step = steps_[next_];
    const Control* button = screen.control(step.control);
    if (!button || !button->enabled) from_s_ = made_up_s + unhurried_s;
    if (made_up_s < from_s_) return std::nullopt;
    ++next_;
    if (button->chosen && step.action.empty()) return (*this)(screen);  // the selected cube
    if (!step.action.empty()) intended_[state.trial_number].push_back(step.action);
    return tap_within(button->area, step.along);
  }

  /// The actions of each trial.
  const std::map<int, std::vector<std::string>>& intended() const { return intended_; }

 private:
  // Of a new trial, or of one that asks again.
  std::optional<Steps> next_answer(const ScreenState& state) {
    const bool asks_again = state.try_again && state.n_choices > n_choices_;
    if (state.trial_number == trial_ && !asks_again) return std::nullopt;
    return answering_(state, random_);
  }

  void begin(const ScreenState& state, Steps steps) {
    trial_ = state.trial_number;
    n_choices_ = state.n_choices;
    steps_ = std::move(steps);
    next_ = 0;
    from_s_ = made_up_s + unhurried_s;
  }

  Tap tap_within(const Rect& area, double along) {
    const auto anywhere = [&] { return 0.99 * random_.uniform(); };
    const double down_s = made_up_s + 0.1 + 0.2 * random_.uniform();
    const double x = along < 0 ? anywhere() : along;
    return {down_s, down_s + 0.05, area.x + static_cast<float>(x) * area.width,
            area.y + static_cast<float>(anywhere()) * area.height};
  }

  RandomStream random_;
  Answering answering_;
  double begun_s_ = made_up_s;
  int trial_ = 0, n_choices_ = 0;
  Steps steps_;
  std::size_t next_ = 0;
  double from_s_ = 0;  // earlier taps would be too soon after the cubes appeared
  std::map<int, std::vector<std::string>> intended_;
};

std::map<int, std::vector<std::string>> logged_actions(const RecordedSession& sink) {
  std::map<int, std::vector<std::string>> actions;
  int trial = 0;
  for (const RecordedEntry& entry : sink.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    if (recorded->changes.trial) trial = recorded->changes.trial->plan.trial_number;
    if (const auto* action = recorded->event.as<Action>())
      actions[trial].push_back(text_of(*action));
  }
  return actions;
}

Steps any_of(const Steps& answers, RandomStream& random) {
  return {answers[random.below(answers.size())]};
}

Steps choose(const ScreenState&, RandomStream& random) {
  return any_of({{"cube_1", "select 1"}, {"cube_2", "select 2"}}, random);
}

Steps choose_or_none(const ScreenState&, RandomStream& random) {
  return any_of(
      {{"cube_1", "select 1"}, {"cube_2", "select 2"}, {"no_difference", "no_difference"}}, random);
}

// Labels the cubes in random order, at times one of them twice, or does not know.
Steps sort(const ScreenState& state, RandomStream& random) {
  if (random.coin(0.1)) return {{"dont_know", "dont_know"}};
  const auto labels = Sorting::labels_for(state.n_slots);
  std::vector<int> slots(labels.size());
  std::iota(slots.begin(), slots.end(), 1);
  random.shuffle(std::span(slots));
  Steps steps;
  const auto label = [&](int slot, std::string_view name) {
    steps.push_back({fmt::format("cube_{}", slot)});
    steps.push_back({fmt::format("label_{}", name), fmt::format("label {} {}", slot, name)});
  };
  if (random.coin(0.3)) label(slots.front(), labels.back());
  for (std::size_t i = 0; i < slots.size(); ++i) label(slots[i], labels[i]);
  steps.push_back({"validate", "validate"});
  return steps;
}

Steps type_number(const ScreenState& state, RandomStream& random) {
  if (std::any_cast<const Estimation::Offer&>(state.offer).is_standard)
    return {{"validate", "validate"}};
  Steps steps;
  const std::string number = std::to_string(1 + random.below(500));
  for (const char digit : number) steps.push_back({fmt::format("value_key_{}", digit)});
  steps.push_back({"estimate", "estimate " + number});
  return steps;
}

Steps slide(const ScreenState&, RandomStream& random) {
  const auto value = static_cast<int>(random.below(101));
  return {{"value_scale", "", 0.998 * value / 100},
          {"estimate", fmt::format("estimate {}", value)}};
}

std::vector<Block> compared(ComparisonAnswers answers) {
  Comparison::Block block;
  block.name = "c";
  block.answers = answers;
  block.staircases = {
      {200, {"c", ConstantConfig{.levels = {-100, 0, 50, 100, 200}, .n_per_level = 10}}}};
  return {block};
}

std::vector<Block> sorted(std::vector<double> masses_g) {
  return {Sorting::Block{"s", std::move(masses_g), {{"C2", n_trials}}}};
}

std::vector<Block> estimated(const std::string& scale) {
  Estimation::Block block;
  block.name = "e";
  block.masses_g = {15, 50, 100, 200, 400};
  block.trials = {{"C2", n_trials / 5}};
  block.scale = scale;
  if (scale == "number") {
    block.low = 1;
    block.high = 500;
    block.modulus = {100, 10};
  }
  return {block};
}

// Each is one trial.
std::vector<Block> introduced() {
  std::vector<Block> blocks;
  for (int i = 0; i < n_trials; ++i)
    blocks.push_back(Introduction::Block{fmt::format("i{}", i), {15, 800}});
  return blocks;
}

/// A task as it is tapped.
struct Tapped {
  std::string name;
  std::vector<Block> blocks;
  Tapper::Answering answering;
  int n_more = 0;  ///< trials besides the fifty
};

class TaskTaps : public ::testing::TestWithParam<TappedSetting> {
 protected:
  std::vector<Tapped> tasks() const {
    std::vector<Tapped> all{
        {"introduction", introduced(), choose},
        {"three-way", compared(ComparisonAnswers::heavier_or_none), choose_or_none},
        {"sorting", sorted({15, 200, 800}), sort},
        {"ranking", sorted({50, 80, 130, 210, 340, 550}), sort}};
    if (!GetParam().is_shipped()) return all;  // texts of tests have no others
    all.push_back({"forced choice", compared(ComparisonAnswers::heavier), choose});
    all.push_back({"number", estimated("number"), type_number, 1});
    all.push_back({"slider", estimated("slider"), slide});
    return all;
  }
};

TEST_P(TaskTaps, TheLogHasTheIntendedActionsAndNoOthers) {
  std::uint64_t seed = 0;
  for (Tapped& task : tasks()) {
    SCOPED_TRACE(fmt::format("{}, seed {}", task.name, ++seed));
    Tapper tapper(seed, task.answering);
    Protocol protocol = testing::protocol_alone(task.blocks.front());
    protocol.blocks = task.blocks;
    TappedSession session(std::move(protocol), std::ref(tapper), GetParam());
    ASSERT_EQ(session.run(), RunEnd::finished);
    EXPECT_EQ(tapper.intended().size(), static_cast<std::size_t>(n_trials + task.n_more));
    EXPECT_EQ(logged_actions(session.sink), tapper.intended());
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, TaskTaps,
                         ::testing::ValuesIn(testing::tapped_settings({"en", "fr", "ar", "ja"})));

}  // namespace
}  // namespace heft
