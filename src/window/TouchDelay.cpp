#include <SDL.h>

#include <string>

#include "base/Clock.h"
#include "base/Random.h"
#include "window/GlWindow.h"
#include "window/WindowView.h"

namespace heft {

namespace {
constexpr const char* form = "taps";
constexpr int n_buttons = 12;
constexpr double period_s = 0.06;  // no button is tapped again before it has settled
static_assert(n_buttons * period_s > settle_s);

// Texts of a page with buttons to tap one after the other.
ScreenTexts with_buttons(ScreenTexts texts) {
  FormQuestion question;
  question.key = "tap";
  question.text = "...";
  for (int i = 1; i <= n_buttons; ++i)
    question.choices.push_back({std::to_string(i), std::to_string(i)});
  texts.pages[questionnaire_page(form)] = {{"title", "..."}};
  texts.questionnaires[form] = {"...", "", {question}};
  return texts;
}

void push(SDL_EventType type, const Control& button, const Measures& measures) {
  SDL_Event event{};
  event.type = type;
  event.tfinger.x = (button.area.x + button.area.width / 2) / measures.width;
  event.tfinger.y = (button.area.y + button.area.height / 2) / measures.height;
  SDL_PushEvent(&event);
}

const Control* button_named(const std::vector<Control>& controls, const std::string& name) {
  for (const Control& control : controls)
    if (control.name == name) return &control;
  return nullptr;
}
}  // namespace

std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps) {
  ViewSetup setup;
  setup.texts = with_buttons(texts);
  setup.windowed = true;
  WindowView view(setup);
  ScreenState screen{.screen = Screen::questionnaire, .form = form, .form_prefix = "taps."};
  view.present({}, screen);
  view.wait(settle_s + period_s);
  RandomStream phase(1, "taps");  // relative to the display's frames
  std::vector<double> delays_s;
  for (int i = 0; i < n_taps; ++i) {
    const std::string value = std::to_string(1 + i % n_buttons);
    const Control* button = button_named(view.controls(), "tap_" + value);
    if (!button) break;
    const double due_s = monotonic_s() + period_s;
    view.wait(phase.uniform() * period_s / 2);
    const double tapped_s = monotonic_s();
    push(SDL_FINGERDOWN, *button, view.measures());
    push(SDL_FINGERUP, *button, view.measures());
    if (!view.wait(period_s).empty()) {
      keep();
      screen.entries["taps.tap"] = value;
      if (const auto presented_s = view.present({}, screen))
        delays_s.push_back(*presented_s - tapped_s);
    }
    view.wait(due_s - monotonic_s());
  }
  return delays_s;
}

}  // namespace heft
