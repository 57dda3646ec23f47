#include "session/DisplayCheck.h"

#include <fmt/format.h>

#include <algorithm>

#include "apparatus/TrialWorld.h"
#include "base/math/Quantiles.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
constexpr const char* check_name = "picture rate";
constexpr int n_wanted = 60;
constexpr double patience_s = 2;                            // for one picture
constexpr double slower = 1.1;                              // a period longer than the protocol's
constexpr double dropped_limit = 0.1, dropped_note = 0.02;  // fractions of pictures
constexpr double mass_g = 200;                              // arbitrary

// What a block's first trial offers; any seed will do.
std::any first_offer(const TaskBlock& block) {
  constexpr std::uint64_t seed = 0;
  ScreenState screen;
  block.trial(block.run(seed)->plan({seed, 1}), seed)->show(screen);
  return screen.offer;
}

// The page with most cubes; a typical one if the protocol has no trials.
ScreenState page_of_trial(const Protocol& protocol) {
  ScreenState screen{.screen = Screen::trial, .task = Sorting::task.name};
  for (const Block& block : protocol.blocks) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    if (!trials || trials->most_cubes() <= screen.n_slots) continue;
    screen.task = trials->task().name;
    screen.n_slots = trials->most_cubes();
    screen.offer = first_offer(*trials);
  }
  if (screen.n_slots == 0) screen.n_slots = 3;
  screen.can_answer = false;
  screen.is_check = true;
  return screen;
}

TrialPlan plan_of(const ScreenState& screen) {
  TrialPlan plan;
  plan.task = screen.task;
  plan.masses_g.assign(static_cast<std::size_t>(screen.n_slots), mass_g);
  return plan;
}

class Trial {
 public:
  explicit Trial(const DisplayedTrial& trial)
      : trial_(trial),
        screen_(page_of_trial(trial.protocol)),
        world_(trial.protocol, plan_of(screen_)),
        start_s_(trial.clock.now_s()) {
    trial_.hand.begin_trial(
        {0, 1, screen_.task, stage_of(trial.protocol, screen_.n_slots), screen_.offer});
    trial_.pictures.begin_attempt({start_s_, before_trials, 1});
  }

  // The first picture is not counted: before it the window writes its texts.
  std::vector<PresentedPicture> run() {
    std::vector<PresentedPicture> presented;
    for (int i = 0; i <= n_wanted; ++i) {
      const auto picture = next();
      if (!picture) break;
      const auto shown = present(*picture);
      if (i > 0) presented.push_back(shown);
    }
    return presented;
  }

 private:
  // None: the camera is silent.
  std::optional<Picture> next() {
    const double since_s = trial_.clock.now_s();
    while (trial_.clock.now_s() < since_s + patience_s) {
      trial_.pictures.skip_to(trial_.clock.now_s() - start_s_);
      auto picture = trial_.pictures.next();
      const bool is_silence = picture && !picture->trouble.empty() && !picture->camera;
      if (picture && !is_silence) {
        const double due_s = start_s_ + picture->sample.t_capture_s;
        while (trial_.clock.now_s() < due_s) trial_.view.wait(due_s - trial_.clock.now_s());
        return picture;
      }
      trial_.view.wait(look_up_s);
    }
    return std::nullopt;
  }

  PresentedPicture present(const Picture& picture) {
    const ViewFrame frame{world_.advance(picture.sample).frame, picture.camera,
                          picture.camera_from_board};
    trial_.hand.see(frame.frame, screen_);
    const auto presented = trial_.view.present(frame, screen_);
    return {start_s_ + picture.sample.t_capture_s,
            presented ? trial_.clock.session_s(*presented) : trial_.clock.now_s(),
            picture.n_dropped};
  }

  DisplayedTrial trial_;
  ScreenState screen_;
  TrialWorld world_;
  double start_s_;
};
}  // namespace

CheckResult display_verdict(const std::vector<PresentedPicture>& pictures, double wanted_rate_hz) {
  if (pictures.size() < 2)
    return {CheckVerdict::failed, check_name, "not measured: no pictures to display arrive"};
  std::vector<double> delays_s;
  int n_dropped = 0;
  for (const PresentedPicture& picture : pictures) {
    delays_s.push_back(picture.present_s - picture.capture_s);
    n_dropped += picture.n_dropped;
  }
  const auto n = static_cast<int>(pictures.size());
  const double period_s = (pictures.back().present_s - pictures.front().present_s) / (n - 1);
  const double dropped = static_cast<double>(n_dropped) / (n + n_dropped);
  const double wanted_s = 1 / wanted_rate_hz, worst_s = *quantile(delays_s, 0.99);
  const std::string figure = fmt::format(
      "a picture each {:.1f} ms, {:.0f} ms after its capture (99 %: {:.0f} ms), {} of {} dropped",
      1e3 * period_s, 1e3 * *quantile(delays_s, 0.5), 1e3 * worst_s, n_dropped, n + n_dropped);
  if (period_s > slower * wanted_s || dropped > dropped_limit)
    return {CheckVerdict::failed, check_name,
            fmt::format("{}, but the protocol displays one each {:.1f} ms: end other programs, use "
                        "a smaller display mode or camera mode, or a machine with a graphics card",
                        figure, 1e3 * wanted_s)};
  if (worst_s > late_periods * wanted_s || dropped > dropped_note)
    return {CheckVerdict::warning, check_name,
            fmt::format("{}; expected within {:.0f} ms, and {:.0f} % dropped at most", figure,
                        1e3 * late_periods * wanted_s, 100 * dropped_note)};
  return {CheckVerdict::ok, check_name, figure};
}

std::vector<CheckResult> check_equipment(const DisplayedTrial& trial) {
  const double rate_hz = trial.protocol.display_rate_hz;
  std::vector<CheckResult> results = trial.pictures.check(rate_hz);
  if (!trial.view.display()) return results;
  results.push_back(trial.pictures.is_endless()
                        ? display_verdict(Trial(trial).run(), rate_hz)
                        : CheckResult{CheckVerdict::ok, check_name,
                                      "not measured: the pictures come from a file"});
  return results;
}

}  // namespace heft
