// A person's whole session with fingers on the real window, on SDL's offscreen display: the session
// gets only pushed finger events.
#include <gmock/gmock.h>

#include <cstdlib>

#include "SourceFolder.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "tasks/Offers.h"
#include "window/WindowTaps.h"

namespace heft {
namespace {

using ::testing::ElementsAre;
using testing::events_of;
using ::testing::IsEmpty;
using testing::shared;
using ::testing::SizeIs;
using testing::whole_protocol;

// Reads the window's controls and taps them as a person would. One tap at a time, and again if it
// had no effect, because a page ignores taps at first.
class FingersOnTheWindow final : public ArView {
 public:
  explicit FingersOnTheWindow(const ViewSetup& setup) : window_(setup) {}

  std::optional<double> present(const ViewFrame& picture, const ScreenState& screen) override {
    cubes_shown_ = !picture.frame.cubes.empty();
    screen_ = screen;
    looked_ = false;
    return window_.present(picture, screen);
  }
  std::vector<Touch> wait(double seconds) override {
    if (!looked_)
      if (const auto name = next_tap()) tap_on(*name);
    looked_ = true;
    auto touches = window_.wait(std::min(seconds, 0.01));
    for (const Touch& touch : touches) given.push_back(touch);
    return touches;
  }

  std::vector<Touch> given;

 private:
  const Control* control(const std::string& name) const {
    for (const Control& one : window_.controls())
      if (one.name == name && one.enabled) return &one;
    return nullptr;
  }
  std::optional<std::string> if_there(const std::string& name) const {
    return control(name) ? std::optional(name) : std::nullopt;
  }

  // Taps cubes in the picture.
  void tap_on(const std::string& name) const {
    if (!name.starts_with("cube_")) return tap(window_, name);
    const auto [x, y] = place_in_picture(window_, name);
    tap_with_finger(x, y);
  }

  std::optional<std::string> next_tap() const {
    switch (screen_.screen) {
      case Screen::trial:
        return cubes_shown_ && screen_.can_answer ? next_answer() : std::nullopt;
      case Screen::about_you:
      case Screen::how_decided:
        return next_in_form();
      default:
        return control("more") ? if_there("more") : if_there("next");
    }
  }

  // The last choice of every question.
  std::optional<std::string> next_in_form() const {
    const Control* last = nullptr;
    for (const Control& one : window_.controls())
      if (one.name != "next" && one.name != "back") last = &one;
    return last && !last->chosen ? std::optional(last->name) : if_there("next");
  }

  std::optional<std::string> next_answer() const {
    if (screen_.task == "introduction")
      return if_there("cube_" + std::to_string(1 + screen_.n_choices % 2));
    if (screen_.task == "comparison")
      return given.size() % 2 ? if_there("cube_2") : if_there("no_difference");
    return next_in_sorting();
  }

  // Labels from left to right, after one mistake.
  std::optional<std::string> next_in_sorting() const {
    const std::array wanted{screen_.n_choices == 0 ? "heaviest" : "lightest", "intermediate",
                            "heaviest"};
    for (int slot = 1; slot <= 3; ++slot) {
      const auto i = static_cast<std::size_t>(slot - 1);
      if (labels_on(std::as_const(screen_)).at(i) == wanted[i]) continue;
      const std::string cube = "cube_" + std::to_string(slot);
      if (const Control* shown = control(cube); !shown || !shown->chosen) return if_there(cube);
      return if_there("label_" + std::string(wanted[i]));
    }
    return if_there("validate");
  }

  WindowView window_;
  ScreenState screen_;
  bool cubes_shown_ = false;
  bool looked_ = false;  // at what is shown: whoever tapped waits for what comes of it
};

class TouchedWindow : public ::testing::Test {
 protected:
  TouchedWindow() {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    ViewSetup setup;
    setup.stage = stage_of(*protocol, 3);
    setup.texts = texts;
    setup.rate_hz = protocol->display_rate_hz;
    fingers.emplace(setup);
  }

  RunEnd run() {
    const auto hand = responder_named("simulated").make({});
    HandPictures pictures(*hand, protocol->display_rate_hz);
    return Runner({*protocol, engine, sink, pictures, *hand, *fingers, clock, true, &texts}, {})
        .run();
  }

  void expect_every_page() const {
    EXPECT_THAT(
        testing::pages_of(sink),
        ElementsAre("consent", "welcome", "about_you", "demonstration", "instructions_sorting",
                    "trial_sorting", "rest", "instructions_introduction", "trial_introduction",
                    "instructions_comparison", "trial_comparison", "how_decided", "thanks"));
    EXPECT_THAT(events_of(sink, event_kind<Consent>), SizeIs(1));
    const auto& info = sink.header().participant_info;
    EXPECT_EQ(info.size(), 8U);
    EXPECT_EQ(info.at("handedness"), "both");
    EXPECT_EQ(info.at("basis"), "guessed");
  }

  // The log has exactly the answers that were tapped.
  void expect_every_answer() const {
    std::vector<Action> answers;
    for (const Touch& touch : fingers->given)
      if (touch.kind == TouchKind::action) answers.push_back(touch.action);
    const auto logged = events_of(sink, event_kind<Action>);
    ASSERT_EQ(logged.size(), answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(logged[i].what, EventPayload(answers[i])) << i;
    }
    std::vector<std::optional<Label>> first_trial;
    for (std::size_t i = 0; i < 5; ++i) first_trial.push_back(logged.at(i).as<Action>()->label);
    EXPECT_THAT(first_trial,
                ElementsAre("heaviest", "lightest", "intermediate", "heaviest", std::nullopt))
        << "corrected, then validated";
  }

  std::shared_ptr<const Protocol> protocol = shared(whole_protocol(30, 4));
  ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/fr.toml");
  Engine engine{protocol, 7};
  RecordedSession sink{SessionHeader{}};
  SessionClock clock = SessionClock::wall_from(0);
  std::optional<FingersOnTheWindow> fingers;
};

TEST_F(TouchedWindow, TakesAPersonThroughAWholeSession) {
  ASSERT_EQ(run(), RunEnd::finished);
  EXPECT_EQ(engine.state(), SessionState::finished);
  EXPECT_EQ(engine.n_completed(), 2 + 1 + 4);
  EXPECT_EQ(engine.n_attempts(), engine.n_completed());
  EXPECT_THAT(events_of(sink, event_kind<Note>), IsEmpty()) << "no tap was one too many";
  expect_every_page();
  expect_every_answer();
}

}  // namespace
}  // namespace heft
