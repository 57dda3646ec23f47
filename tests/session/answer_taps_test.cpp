// Judgments and same-different answers: the intended answer is tapped and logged, in both shipped
// languages, in four window sizes, right-handed and left-handed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Random.h"
#include "session/TappedSession.h"
#include "tasks/Comparison.h"
#include "tasks/Judgment.h"

namespace heft {
namespace {

using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

FormQuestion question(QuestionKind kind) {
  FormQuestion asked;
  asked.key = "asked";
  asked.kind = kind;
  asked.text = "A question that is long enough for two lines above the cubes, isn't it?";
  asked.low = "Not at all";
  asked.high = "Very much so";
  asked.least = 1;
  asked.most = 9;  // a digit that is tapped twice is no answer
  for (const char* value : {"left", "none", "right", "both", "unsure"})
    asked.choices.push_back({value, value});
  return asked;
}

/// Taps an answer of each trial, and confirms it once it is shown.
class Judge {
 public:
  Judge(std::uint64_t seed, const FormQuestion& asked) : random_(seed, "judge"), asked_(asked) {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const Control* wanted = wanted_on(screen);
    if (!wanted) return std::nullopt;
    const double along = wanted->slide ? 0.998 * meant_[screen.screen().trial_number] / 100 : 0.5;
    return testing::tap_on(wanted, random_, along);
  }

  const std::map<int, double>& meant() const { return meant_; }

 private:
  const Control* wanted_on(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.screen != Screen::trial) return testing::onwards(screen);
    if (state.faded || !state.can_answer) return nullptr;
    const auto [meant, is_new] = meant_.try_emplace(state.trial_number);
    if (is_new) meant->second = any();
    const Control* answer = screen.control(control_for(meant->second));
    const Control* confirm = screen.control("judge");
    const bool is_shown =
        answer && (answer->slide ? answer->slide->fraction.has_value()
                                 : answer->chosen || asked_.kind == QuestionKind::number);
    return is_shown && confirm && confirm->enabled ? confirm : answer;
  }

  double any() {
    const AnswerScale scale = Judgment::scale(asked_);
    return asked_.kind == QuestionKind::number ? static_cast<double>(1 + random_.below(9))
                                               : scale.any(random_.uniform());
  }

  std::string control_for(double value) const {
    if (asked_.kind == QuestionKind::slider) return "asked_scale";
    if (asked_.kind == QuestionKind::choice)
      return "asked_" + asked_.choices.at(static_cast<std::size_t>(value) - 1).value;
    return fmt::format("asked_{}{:g}", asked_.kind == QuestionKind::number ? "key_" : "", value);
  }

  RandomStream random_;
  FormQuestion asked_;
  std::map<int, double> meant_;
};

Judgment::Block judgments_of(const FormQuestion& asked) {
  Judgment::Block block;
  block.name = "judgment";
  block.masses_g = {15, 100, 200, 400, 800};
  block.cubes = 2;
  block.trials = {{"C2", 5}};
  block.asks = "mine.asked";
  block.question = asked;
  return block;
}

TEST(JudgmentTaps, WhatWasTappedIsWhatIsLogged) {
  std::uint64_t seed = 0;
  for (const QuestionKind kind :
       {QuestionKind::choice, QuestionKind::likert, QuestionKind::slider, QuestionKind::number})
    for (const testing::TappedSetting& setting : testing::tapped_settings()) {
      SCOPED_TRACE(fmt::format("{} {}", name_of(kind), ::testing::PrintToString(setting)));
      const FormQuestion asked = question(kind);
      Judge judge(++seed, asked);
      TappedSession session(testing::protocol_alone(judgments_of(asked)), std::ref(judge), setting);
      ASSERT_EQ(session.run(), RunEnd::finished);
      std::map<int, double> logged;
      for (const RecordedEntry& entry : session.sink.entries())
        if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
          if (const auto& row = recorded->changes.trial;
              row && row->status == TrialStatus::completed) {
            EXPECT_EQ(row->outcome, kind == QuestionKind::choice ? "chosen" : "judged");
            logged[row->plan.trial_number] = *row->value;
          }
      EXPECT_EQ(logged.size(), 50u);
      EXPECT_EQ(logged, judge.meant());
      EXPECT_EQ(testing::events_of(session.sink, event_kind<Action>).size(), 50u)
          << "one answer a trial";
    }
}

// Taps "same" or "different" by the words on the buttons.
class Comparer {
 public:
  Comparer(std::uint64_t seed, const ScreenTexts& texts)
      : random_(seed, "comparer"), texts_(texts) {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.faded || (state.screen == Screen::trial && !state.can_answer)) return std::nullopt;
    if (state.screen == Screen::trial) meant_.try_emplace(state.trial_number, random_.coin(0.5));
    for (const Control& control : screen.page().controls) {
      const bool is_meant =
          state.screen == Screen::trial
              ? control.text ==
                    texts_.at("trial_comparison", meant_[state.trial_number] ? "different" : "same")
              : control.name == "next" || control.name == "more";
      if (!is_meant || !control.enabled) continue;
      return testing::tap_on(control, random_);
    }
    return std::nullopt;
  }

  const std::map<int, bool>& meant() const { return meant_; }

 private:
  RandomStream random_;
  const ScreenTexts& texts_;
  std::map<int, bool> meant_;  // whether different, by trial
};

TEST(SameDifferentTaps, WhatWasTappedIsWhatIsLogged) {
  Comparison::Block block;
  block.name = "c";
  block.answers = ComparisonAnswers::same_different;
  block.staircases = {
      {200, {"c", ConstantConfig{.levels = {-100, 0, 50, 100, 200}, .n_per_level = 10}}}};
  for (const testing::TappedSetting& setting : testing::tapped_settings()) {
    SCOPED_TRACE(::testing::PrintToString(setting));
    const ScreenTexts texts = setting.texts();
    Comparer comparer(7, texts);
    TappedSession session(testing::protocol_alone(block), std::ref(comparer), setting);
    ASSERT_EQ(session.run(), RunEnd::finished);
    std::map<int, bool> logged;
    for (const RecordedEntry& entry : session.sink.entries())
      if (const auto* recorded = std::get_if<RecordedEvent>(&entry))
        if (const auto& row = recorded->changes.trial; row && row->status == TrialStatus::completed)
          logged[row->plan.trial_number] = row->outcome == "difference";
    EXPECT_EQ(logged.size(), 50u);
    EXPECT_EQ(logged, comparer.meant());
  }
}

}  // namespace
}  // namespace heft
