#include "session/Pages.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/Sha256.h"
#include "protocol/TextsFile.h"
#include "session/Demonstration.h"

namespace heft {

namespace {
constexpr double still_page_step_s = 0.1;
}  // namespace

bool Pages::welcome() {
  const ScreensChosen& chosen = journal_.engine().protocol().screens;
  if (chosen.consent) {
    const TouchKind answer = show(Screen::consent);
    if (answer == TouchKind::close) return true;
    const bool agreed = answer == TouchKind::next;
    journal_.emit_now(EventKind::consent,
                      nlohmann::ordered_json{{"agreed", agreed},
                                             {"language", texts_->language},
                                             {"sha256", sha256(page_text(*texts_, "consent"))}}
                          .dump());
    if (!agreed) return false;
  }
  show(Screen::welcome);
  if (chosen.about_you) show(Screen::about_you);
  return true;
}

void Pages::instructions(Task task) {
  show(ScreenState{.screen = Screen::instructions, .task = task});
}

void Pages::demonstration(const DemonstrationBlock& block) {
  const Engine& engine = journal_.engine();
  Demonstration moving(engine.protocol(), engine.seed());
  show(ScreenState{.screen = Screen::demonstration}, block.duration_s,
       [&](double t_s) { return moving.at(t_s); });
}

void Pages::rest(double least_s) {
  show(ScreenState{.screen = Screen::rest}, least_s);
}

void Pages::how_decided() {
  if (journal_.engine().protocol().screens.how_decided) show(Screen::how_decided);
}

void Pages::thanks() {
  show(Screen::thanks);
}

TouchKind Pages::show(ScreenState screen, double least_s, const Moving& picture_at) {
  const double since_s = journal_.clock().now_s();
  const double step_s =
      picture_at ? 1 / journal_.engine().protocol().display_rate_hz : still_page_step_s;
  while (!attendant_.leaving()) {
    note_text(screen);  // again after the experimenter held the session
    const double elapsed_s = journal_.clock().now_s() - since_s;
    screen.wait_s = std::max(0.0, least_s - elapsed_s);
    view_.present(picture_at ? picture_at(elapsed_s) : ViewPicture{}, screen);
    for (const Touch& touch : attendant_.wait(step_s)) {
      if (touch.kind == TouchKind::entry) journal_.sink().add_info(touch.key, touch.value);
      if (touch.kind == TouchKind::decline) return touch.kind;
      if (touch.kind == TouchKind::next && screen.wait_s == 0) return touch.kind;
    }
  }
  return TouchKind::close;
}

void Pages::note_text(const ScreenState& screen) {
  if (!texts_) return;
  const std::string page = text_page(screen.screen, screen.task);
  if (page == shown_) return;
  shown_ = page;
  journal_.emit_now(EventKind::text_shown,
                    nlohmann::ordered_json{{"page", page},
                                           {"language", texts_->language},
                                           {"sha256", sha256(page_text(*texts_, page))}}
                        .dump());
}

}  // namespace heft
