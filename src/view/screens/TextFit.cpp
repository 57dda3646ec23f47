#include "view/screens/TextFit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tasks/Task.h"
#include "view/screens/Screens.h"

namespace heft {

namespace {
constexpr float least_size = 0.7f;  // relative to the usual size of texts

// Every screen with texts, as full as it can be.
std::vector<ScreenState> states(const ScreenTexts& texts) {
  std::vector<ScreenState> all;
  for (std::size_t i = 0; i < EnumNames<Screen>::names.size(); ++i)
    if (const auto screen = static_cast<Screen>(i); screen != Screen::trial &&
                                                    screen != Screen::instructions &&
                                                    screen != Screen::questionnaire)
      all.push_back({.screen = screen});
  for (const Task task : words_of<Task>()) {
    if (!texts.pages.contains(text_page(Screen::trial, task))) continue;  // no texts for this task
    all.push_back({.screen = Screen::instructions, .task = task});
    for (const Wording& wording : task_named(task).wordings)
      if (!texts.if_any(text_page(all.back()), instructions_key(wording.name)).empty())
        all.push_back(
            {.screen = Screen::instructions, .task = task, .wording = std::string(wording.name)});
    for (ScreenState trial : fullest_screens(task)) {
      trial.screen = Screen::trial;
      trial.task = task;
      all.push_back(trial);
      trial.touch_first = true;
      all.push_back(trial);
    }
  }
  if (const ScreenState page{.screen = Screen::instructions, .task = "after_practice"};
      texts.pages.contains(text_page(page)))
    all.push_back(page);
  all.push_back({.screen = Screen::rest, .wait_s = 599});
  for (const auto& [name, questionnaire] : texts.questionnaires)
    all.push_back({.screen = Screen::questionnaire, .form = name, .form_prefix = name});
  return all;
}

class FitCheck {
 public:
  FitCheck(const ScreenTexts& texts, const Measures& measures)
      : measures_(measures), typeface_(Typeface::for_measuring(texts)), screens_(texts, false) {}

  void check(const ScreenState& state) {
    screens_.show(state, true);
    name_ = text_page(state);
    constexpr int most_parts = 100;
    for (int i = 0; i < most_parts && check(screens_.page(typeface_, measures_)); ++i) continue;
  }

  std::vector<std::string> found;

 private:
  // @return whether another part was shown
  bool check(const Page& page) {
    for (const Control& control : page.controls) {
      const ControlWords words = words_on(control, typeface_, measures_);
      check(control.text, words.text, words.text_area, "on its button");
      if (!control.note.empty()) check(control.note, words.note, words.note_area, "on its button");
    }
    for (const TextLine& line : page.lines) check(line, page);
    if (page.scene && !page.notice.empty()) {
      const NoticeWords notice = words_of_notice(page.notice, *page.scene, typeface_, measures_);
      check(page.notice, notice.text, notice.area, "over the scene");
    }
    return turned(page);
  }

  void check(const std::string& text, const FittedText& words, const Rect& area,
             std::string_view where) {
    const bool wide = std::ranges::any_of(words.lines, [&](const std::string& line) {
      return typeface_.width_px(line, words.size_px) > area.width;
    });
    const float height_px = static_cast<float>(words.lines.size()) * words.size_px;
    if (wide || height_px > area.height)
      add_sentence(text, fmt::format("does not fit {}", where));
    else if (words.size_px < least_size * measures_.body)
      add_sentence(text, fmt::format("fits {} only in small letters", where));
  }

  void check(const TextLine& line, const Page& page) {
    const Rect area{line.x, line.y, typeface_.width_px(line.text, line.size_px), line.size_px};
    const Rect window{0, 0, measures_.width, measures_.height};
    const bool inside =
        area.x >= 0 && area.right() <= window.right() && area.bottom() <= window.bottom();
    const bool covered = std::ranges::any_of(
        page.controls, [&](const Control& control) { return control.area.overlaps(area); });
    if (!inside || covered || (page.scene && page.scene->overlaps(area)))
      add_sentence(line.text, "does not fit its place");
    else if (line.size_px < least_size * measures_.body)
      add_sentence(line.text, "fits its place only in small letters");
  }

  void add_sentence(const std::string& text, const std::string& what) {
    std::string sentence = fmt::format("{}: \"{}\" {}", name_, text, what);
    if (std::ranges::find(found, sentence) == found.end()) found.push_back(std::move(sentence));
  }

  bool turned(const Page& page) {
    for (const Control& control : page.controls)
      if (const auto* turn = std::get_if<TurnPart>(&control.effect); turn && turn->by > 0) {
        screens_.tapped(control);
        return true;
      }
    return false;
  }

  Measures measures_;
  Typeface typeface_;
  Screens screens_;
  std::string name_;
};
}  // namespace

Measures smallest_screen(double text_size) {
  return {1024, 600, static_cast<float>(text_size)};
}

std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures) {
  return texts_that_do_not_fit(texts, measures, states(texts));
}

std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures,
                                               const std::vector<ScreenState>& screens) {
  FitCheck fit(texts, measures);
  for (const ScreenState& state : screens) fit.check(state);
  return fit.found;
}

namespace {
// A letter or a number: it fits anywhere, and small letters would make it illegible.
bool is_letter_or_number(const std::string& text) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return (text.size() == 1 && std::isalnum(static_cast<unsigned char>(text.front())) != 0) ||
         (!text.empty() && std::ranges::all_of(text, is_digit));
}
}  // namespace

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures) {
  const float pad = 0.07f * measures.target;
  Rect inside{control.area.x + pad, control.area.y + pad, control.area.width - 2 * pad,
              control.area.height - 2 * pad};
  ControlWords words;
  if (!control.note.empty()) {
    inside.height /= 2;
    words.note_area = {inside.x, inside.bottom(), inside.width, inside.height};
    words.note = typeface.fitted(control.note, measures.body, words.note_area.width,
                                 words.note_area.height, measures.least_px(measures.body));
  }
  words.text_area = inside;
  words.text = typeface.fitted(control.text, measures.body, inside.width, inside.height,
                               measures.least_px(measures.body));
  return words;
}

std::vector<ControlWords> words_on(const std::vector<Control>& controls, const Typeface& typeface,
                                   const Measures& measures) {
  std::vector<ControlWords> all;
  for (const Control& control : controls) all.push_back(words_on(control, typeface, measures));
  const auto are_alike = [](const ControlWords& a, const ControlWords& b) {
    constexpr float rounding_px = 0.5f;
    return std::abs(a.text_area.width - b.text_area.width) < rounding_px &&
           std::abs(a.text_area.height - b.text_area.height) < rounding_px;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    FittedText& text = all[i].text;
    float size_px = text.size_px;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (are_alike(all[j], all[i]) &&
          is_letter_or_number(controls[j].text) == is_letter_or_number(controls[i].text))
        size_px = std::min(size_px, all[j].text.size_px);
    if (size_px < text.size_px)
      text = typeface.fitted(controls[i].text, size_px, all[i].text_area.width,
                             all[i].text_area.height, size_px);
  }
  return all;
}

NoticeWords words_of_notice(const std::string& notice, const Rect& scene, const Typeface& typeface,
                            const Measures& measures, bool at_top) {
  const float margin = measures.margin;
  NoticeWords words{typeface.fitted(notice, measures.body, scene.width - 4 * margin,
                                    0.25f * scene.height, measures.least_px(measures.body)),
                    {}};
  const auto& [size_px, lines] = words.text;
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, typeface.width_px(line, size_px));
  width += 2 * margin;
  const float height =
      Typeface::line_height_px(size_px) * static_cast<float>(lines.size()) + 1.2f * margin;
  const float y = at_top ? scene.y + margin : scene.bottom() - margin - height;
  words.area = {scene.x + (scene.width - width) / 2, y, width, height};
  return words;
}

Rect place_of(const Patch& patch, const Measures& measures) {
  const float size = 2 * measures.margin;
  return {patch.left ? 0 : measures.width - size, measures.height - size, size, size};
}

}  // namespace heft
