// The program is suspended at a random moment of a person's session: the open trial is paused for
// that time, and voided if it is long. Failures print their seed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "SourceFolder.h"
#include "apparatus/TrialWorld.h"
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

// A clock that jumps at one of its readings, as it does when the program was stopped before it.
struct Freeze {
  int at_reading = 0;
  double length_s = 0;
  int n_readings = 0;
  double began_s = 0, ended_s = 0;  // of the made-up clock
};
Freeze freeze;

double freezing_monotonic() {
  if (++freeze.n_readings == freeze.at_reading) {
    freeze.began_s = made_up_s;
    made_up_s += freeze.length_s;
    freeze.ended_s = made_up_s;
  }
  return made_up_s;
}

// Taps one enabled control after the other.
class Tapper {
 public:
  explicit Tapper(std::uint64_t seed) : random_(seed, "taps") {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    std::vector<const Control*> live;
    for (const Control& control : screen.page().controls)
      if (control.enabled && control.name != "decline") live.push_back(&control);
    if (live.empty()) return std::nullopt;
    const Rect& area = live[random_.below(live.size())]->area;
    const double down_s = made_up_s + 0.75 + 0.5 * random_.uniform();
    return Tap{down_s, down_s + 0.08, area.x + area.width / 2, area.y + area.height / 2};
  }

 private:
  RandomStream random_;
};

struct FrozenSession {
  FrozenSession(std::uint64_t seed, int at_reading, double length_s)
      : session(testing::quick_protocol(), load_texts(source_folder() + "/protocols/texts/en.toml"),
                Tapper(seed)) {
    freeze = {at_reading, length_s};
    started_s = made_up_s;
    session.clock = SessionClock::wall_from(0, freezing_monotonic);
    end = session.run();
  }
  double began_s() const { return freeze.began_s - started_s; }
  double ended_s() const { return freeze.ended_s - started_s; }

  TappedSession session;
  double started_s = 0;
  RunEnd end = RunEnd::stopped;
};

std::vector<TrialRow> trials_of(const RecordedSession& recorded) {
  std::map<int, TrialRow> trials;
  for (const RecordedEntry& entry : recorded.entries())
    if (const auto* event = std::get_if<RecordedEvent>(&entry); event && event->changes.trial)
      trials[event->changes.trial->attempt_index] = *event->changes.trial;
  std::vector<TrialRow> rows;
  for (const auto& [index, row] : trials) rows.push_back(row);
  return rows;
}

TEST(Standstill, IsNeverPartOfAResponseTime) {
  FrozenSession whole(1, 0, 0);
  ASSERT_EQ(whole.end, RunEnd::finished);
  const int n_readings = freeze.n_readings;
  int n_in_answers = 0, n_voided = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    RandomStream random(seed, "standstill");
    const int at = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(n_readings)));
    const double length_s =
        random.coin(0.5) ? 0.5 + 4 * random.uniform() : 6 + 24 * random.uniform();
    SCOPED_TRACE(fmt::format("seed {}: {:.2f} s at reading {}", seed, length_s, at));
    const FrozenSession frozen(1, at, length_s);
    EXPECT_EQ(frozen.end, RunEnd::finished);
    for (const TrialRow& row : trials_of(frozen.session.sink)) {
      if (!row.shown_s || *row.shown_s > frozen.began_s()) continue;
      const double over_s = row.validated_s.value_or(*row.ended_s);
      if (over_s < frozen.ended_s()) continue;
      ++n_in_answers;
      EXPECT_GE(row.paused_s, length_s - 0.01);
      EXPECT_LE(row.paused_s, length_s + 0.1);
      const bool is_long = length_s > frozen.session.protocol->void_after_s + 0.1;
      if (is_long) ++n_voided;
      EXPECT_EQ(row.status, is_long ? TrialStatus::voided : TrialStatus::completed);
    }
  }
  EXPECT_GT(n_in_answers, 40);
  EXPECT_GT(n_voided, 10);
}

TEST(Standstill, ShortOnesAreNoPause) {
  for (int at = 200; at < 2000; at += 200) {
    const FrozenSession frozen(1, at, 0.3);
    EXPECT_THAT(testing::events_of(frozen.session.sink, event_kind<SessionPaused>),
                ::testing::IsEmpty());
  }
}

TEST(Standstill, EndsAContactBeforeIt) {
  const Protocol protocol = testing::quick_protocol();
  TrialPlan plan;
  plan.condition = "C2";
  plan.masses_g = {200};
  for (const bool ends : {true, false}) {
    Protocol ruled = protocol;
    ruled.gaps_end_contacts = ends;
    TrialWorld world(ruled, plan);
    double contact_s = -1, t_s = 0;
    const auto look = [&](double y_m) {
      TargetSample sample;
      sample.t_capture_s = t_s;
      sample.tracked = true;
      sample.pose.position_m = {0, y_m, 0.02};
      for (const Event& event : world.advance(sample).events)
        if (const auto* touched = event.as<CubeTouch>(); touched && touched->ended_after_s)
          contact_s = *touched->ended_after_s;
    };
    for (; t_s < 2; t_s += 1.0 / 15) look(-0.2 + 0.1 * t_s);  // pushes from about 1.5 s on
    t_s += 20;
    for (int i = 0; i < 15; ++i, t_s += 1.0 / 15) look(-0.2);
    EXPECT_GT(contact_s, 0);
    EXPECT_EQ(contact_s < 2, ends) << contact_s;
  }
}

// Notes when contacts arrive. A contact's time is that of its picture, which was captured before.
class WhenTouched final : public EventSink {
 public:
  void append(const Event& event, const Changes&, Durability) override {
    if (event.is<CubeTouch>()) waiting_s_.push_back(made_up_s);
  }
  void add_frame(const FrameRow& frame) override {
    for (const double at_s : std::exchange(waiting_s_, {}))
      delays_s.push_back(at_s - started_s - *frame.simulated_s);
  }
  void add_info(const std::string&, const std::string&) override {}
  void flush() override {}

  const double started_s = made_up_s;
  std::vector<double> delays_s;  ///< from the end of the simulation that found the contact

 private:
  std::vector<double> waiting_s_;
};

// So that triggers do not wait for the picture.
TEST(Contacts, ArriveBeforeTheirPictureIsDrawn) {
  std::size_t n = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TappedSession session(testing::quick_protocol(),
                          load_texts(source_folder() + "/protocols/texts/en.toml"), Tapper(seed));
    WhenTouched touched;
    ASSERT_EQ(session.run_into(touched), RunEnd::finished);
    for (const double delay_s : touched.delays_s) {  // negative: ended by an answer in between
      EXPECT_LE(delay_s, 1e-4);
      n += delay_s > -1e-4;
    }
  }
  EXPECT_GT(n, 10u);
}

}  // namespace
}  // namespace heft
