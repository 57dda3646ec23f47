// Double taps and random taps in a person's whole sessions, with the rules of onset. The seed of a
// failure is printed.
#include <gmock/gmock.h>

#include <set>

#include "SourceFolder.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/TappedSession.h"

namespace heft {
namespace {

using testing::made_up_s;
using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

// A consent page of several parts.
ScreenTexts long_texts() {
  ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/en.toml");
  for (int i = 0; i < 60; ++i) texts.pages["consent"]["text"] += " There is more to read.";
  return texts;
}

double between(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

// Each attempt's answers, by the time since its cubes were shown; asserts that they were.
std::vector<double> answer_times_s(const TappedSession& session) {
  std::optional<double> shown_s;
  std::vector<double> times;
  for (const RecordedEntry& entry : session.sink.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    if (recorded->event.as<TrialStarted>()) shown_s.reset();
    if (recorded->event.as<CubesShown>()) shown_s = recorded->event.t_s;
    if (!recorded->event.as<Action>()) continue;
    EXPECT_TRUE(shown_s) << "an answer to cubes that nobody has seen";
    times.push_back(recorded->event.t_s - shown_s.value_or(1e9));
  }
  return times;
}

std::size_t n_actions(const TappedSession& session) {
  return testing::events_of(session.sink, event_kind<Action>).size();
}

// Taps everything twice, 60 to 600 ms apart, each time on any control that is there.
class DoubleTapper {
 public:
  explicit DoubleTapper(std::uint64_t seed) : random_(seed, "double taps") {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    if (second_) return *std::exchange(second_, std::nullopt);
    const Control* control = choose(screen);
    if (!control) return std::nullopt;
    const double down_s = made_up_s + between(random_, 0.75, 1.5);
    const double held_s = between(random_, 0.02, 0.12), apart_s = between(random_, 0.06, 0.6);
    const Rect& area = control->area;
    const auto x = area.x + static_cast<float>(random_.uniform()) * 0.99f * area.width;
    const auto y = area.y + static_cast<float>(random_.uniform()) * 0.99f * area.height;
    second_ = Tap{down_s + held_s + apart_s, down_s + 2 * held_s + apart_s, x, y};
    return Tap{down_s, down_s + held_s, x, y};
  }

 private:
  // Any enabled control; mostly one that continues, or the session would hardly progress.
  const Control* choose(const TappedScreen& screen) {
    std::vector<const Control*> live;
    for (const Control& control : screen.page().controls)
      if (control.enabled) live.push_back(&control);
    const bool reads =
        screen.screen().screen == Screen::consent && live.size() < screen.page().controls.size();
    if (live.empty() || reads) return nullptr;
    const auto leads_on = std::ranges::find_if(live, [](const Control* control) {
      return control->name == "next" || control->name == "more" || control->name == "validate";
    });
    if (leads_on != live.end() && random_.coin(0.5)) return *leads_on;
    const Control* any = live[random_.below(live.size())];
    const bool ends_soon = any->name == "dont_know" || any->name == "decline";
    return ends_soon && random_.coin(0.9) ? live.front() : any;
  }

  RandomStream random_;
  std::optional<Tap> second_;
};

TEST(Taps, ADoubleTapOnAnyButtonOfAnyPageDoesOneThing) {
  std::set<std::string> tapped;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    TappedSession session(testing::whole_protocol(15, 6), long_texts(), DoubleTapper(seed));
    const RunEnd end = session.run();
    EXPECT_THAT(end, ::testing::AnyOf(RunEnd::finished, RunEnd::declined));
    const auto& done = session.screen.done;
    for (std::size_t i = 0; i + 1 < done.size(); i += 2) {
      const auto &first = done[i], &second = done[i + 1];
      tapped.insert(first.control);
      EXPECT_LE(first.n_touches, 1U) << first.control;
      EXPECT_EQ(second.n_touches, 0U) << second.control << " " << second.tap.down_s - first.tap.up_s
                                      << " s after " << first.control;
      EXPECT_FALSE(second.changed_page) << second.control << " after " << first.control;
    }
    for (const double t_s : answer_times_s(session)) EXPECT_GE(t_s, testing::min_answer_s - 1e-5);
  }
  for (const char* name : {"next", "more", "decline", "back", "cube_1", "cube_2", "cube_3",
                           "label_lightest", "label_heaviest", "validate", "dont_know",
                           "no_difference", "put_cubes_back", "age_18_24", "basis_felt"})
    EXPECT_TRUE(tapped.contains(name)) << name << " was never tapped";
}

// Touches at random places and times and of random duration, half of them on buttons.
class WildTapper {
 public:
  WildTapper(std::uint64_t seed, int& n_taps) : random_(seed, "wild taps"), n_taps_(&n_taps) {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    ++*n_taps_;
    const double down_s = made_up_s + 0.7 * random_.uniform() * random_.uniform();
    Tap tap{down_s, down_s + between(random_, 0.01, 0.3),
            static_cast<float>(between(random_, 0, 1024)),
            static_cast<float>(between(random_, 0, 600))};
    const auto& controls = screen.page().controls;
    if (controls.empty() || random_.coin(0.3)) return tap;
    const Rect& area = controls[random_.below(controls.size())].area;
    tap.x = area.x + area.width / 2;
    tap.y = area.y + area.height / 2;
    return tap;
  }

 private:
  RandomStream random_;
  int* n_taps_;
};

TEST(Taps, OfTwoThousandWildOnesNoneAnswersUnseenCubes) {
  Protocol protocol = testing::whole_protocol(15, 6);
  protocol.screens = {"en", false, false, false};
  int n_taps = 0;
  std::size_t n_answers = 0, n_refused = 0;
  for (std::uint64_t seed = 1; n_taps < 2000; ++seed) {
    SCOPED_TRACE(seed);
    TappedSession session(protocol, long_texts(), WildTapper(seed, n_taps));
    ASSERT_EQ(session.run(), RunEnd::finished);
    for (const double t_s : answer_times_s(session)) EXPECT_GE(t_s, testing::min_answer_s - 1e-5);
    n_answers += n_actions(session);
    for (const Event& event : testing::events_of(session.sink, event_kind<ActionRefused>)) {
      ++n_refused;
      EXPECT_FALSE(event.as<ActionRefused>()->reason.empty());
    }
  }
  EXPECT_GT(n_answers, 50U) << "somebody did answer";
  EXPECT_GT(n_refused, 5U) << "what came too early is kept";
}

}  // namespace
}  // namespace heft
