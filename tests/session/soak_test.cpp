// A laboratory's day: sessions one after the other, 30 pictures a second, through the window and
// the log, on a virtual clock. HEFT_SOAK_HOURS sets the simulated hours (a minute otherwise).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "SourceFolder.h"
#include "base/Clock.h"
#include "base/math/Quantiles.h"
#include "protocol/readers/Files.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Runner.h"
#include "window/WindowView.h"

namespace heft {
namespace {

constexpr double rate_hz = 30;

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Passes everything on to a log, and watches times.
class WatchedLog final : public EventSink {
 public:
  WatchedLog(SessionLog& log, double stop_s) : log_(log), stop_s_(stop_s) {}

  void append(const Event& event, const Changes& changes, Durability durability) override {
    if (event.as<TrialStarted>()) start_s_ = event.t_s;
    stop = event.t_s >= stop_s_;
    timed([&] { log_.append(event, changes, durability); });
  }
  void add_frame(const FrameRow& frame) override {
    ++n_frames;
    const double number = frame.trial_t_s * rate_hz;
    drift_s = std::max(drift_s, std::abs(number - std::round(number)) / rate_hz);
    drift_s = std::max(drift_s, std::abs(frame.t_s - start_s_ - frame.trial_t_s));
    stop = frame.t_s >= stop_s_;
    timed([&] { log_.add_frame(frame); });
  }
  void add_info(const std::string& key, const std::string& value) override {
    log_.add_info(key, value);
  }
  void flush() override {
    timed([&] { log_.flush(); });
  }

  std::atomic<bool> stop = false;
  int n_frames = 0;
  double drift_s = 0;  ///< largest distance of a frame's time from its number
  std::vector<double> writes_s;

 private:
  template <typename Write>
  void timed(const Write& write) {
    const double since_s = monotonic_s();
    write();
    writes_s.push_back(monotonic_s() - since_s);
  }

  SessionLog& log_;
  double stop_s_, start_s_ = 0;
};

class Day : public ::testing::Test {
 protected:
  Day() {
    if (!std::getenv("DISPLAY")) setenv("SDL_VIDEODRIVER", "offscreen", 1);
    Protocol paper = load_protocol(source_folder() + "/protocols/paper.toml",
                                   std::vector<ProtocolSetting>{{"display_rate_hz", "30"}});
    protocol = std::make_shared<const Protocol>(std::move(paper));
    ViewSetup setup;
    setup.stage = stage_of(*protocol, 3);
    setup.texts = load_texts(source_folder() + "/protocols/texts/en.toml");
    setup.windowed = true;
    setup.rate_hz = rate_hz;
    view.emplace(setup);
  }

  // @return simulated seconds
  double run_session(int number, double most_s) {
    SessionHeader header = test::header_of("P" + std::to_string(number));
    header.protocol_name = protocol->name;
    header.protocol_text = protocol->text;
    header.protocol_sha256 = protocol->sha256;
    header.seed = static_cast<std::uint64_t>(number);
    Engine engine(protocol, header.seed);
    SessionConfig setup;
    setup.simulator = protocol->simulator.name;
    const Event first{0, setup};
    SessionLog log = SessionLog::start(path, header, RecordedEvent{first, engine.apply(first)});
    WatchedLog watched(log, most_s);
    ResponderOptions seeded;
    seeded.seed = header.seed;
    const auto hand = responder_named("simulated").make(seeded);
    HandPictures pictures(*hand, protocol->display_rate_hz);
    SessionClock clock = SessionClock::virtual_from(0);
    RunnerOptions options;
    options.stop = &watched.stop;
    const SessionParts parts{*protocol, engine, watched, pictures, *hand, *view, clock};
    Runner(parts, options).run();
    log.seal();
    n_frames += watched.n_frames;
    drift_s = std::max(drift_s, watched.drift_s);
    writes_s.insert(writes_s.end(), watched.writes_s.begin(), watched.writes_s.end());
    return engine.last_s();
  }

  const test::TemporaryFolder folder;
  const std::string path = folder.file("day.db");
  std::shared_ptr<const Protocol> protocol;
  std::optional<WindowView> view;
  int n_frames = 0;
  double drift_s = 0;
  std::vector<double> writes_s;
};

TEST_F(Day, MemoryStaysFlatAndNothingDrifts) {
  const char* wanted = std::getenv("HEFT_SOAK_HOURS");
  const double end_s = wanted ? 3600 * std::atof(wanted) : 60;
  const double since_s = monotonic_s();
  double simulated_s = 0, after_first_mb = 0;
  int n_sessions = 0;
  while (simulated_s < end_s) {
    simulated_s += run_session(++n_sessions, end_s - simulated_s);
    writes_s.shrink_to_fit();
    if (n_sessions == 1) after_first_mb = resident_mb();
    if (wanted)
      std::printf("%2d sessions, %5.2f h: %.0f MB, %d frames\n", n_sessions, simulated_s / 3600,
                  resident_mb(), n_frames);
  }
  const double own_mb = static_cast<double>(writes_s.size() * sizeof(double)) / 1e6;
  EXPECT_LT(resident_mb() - own_mb, after_first_mb + 10) << "MB after " << n_sessions;
  EXPECT_LT(drift_s, 1e-6);
  EXPECT_GT(n_frames, 0.5 * simulated_s * rate_hz) << "pauses between trials have no frames";
  if (wanted)
    std::printf(
        "%.0f times as fast as the clock; writes: median %.3f ms, 99.9 %% %.1f ms, "
        "longest %.1f ms; drift %.1e s\n",
        simulated_s / (monotonic_s() - since_s), 1e3 * *quantile(writes_s, 0.5),
        1e3 * *quantile(writes_s, 0.999), 1e3 * std::ranges::max(writes_s), drift_s);
  const LogReader reader(path);
  EXPECT_EQ(static_cast<int>(reader.sessions().size()), n_sessions);
  EXPECT_FALSE(fault_of_structure(reader));
  for (const SessionRow& session : reader.sessions()) {
    const Verification found = verify_rows(reader, session.session_id);
    EXPECT_FALSE(found.first) << session.session_id << ": " << found.first->what << " is "
                              << found.first->logged << ", expected " << found.first->replayed;
  }
}

}  // namespace
}  // namespace heft
