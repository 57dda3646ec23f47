#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "view/window/ScreenPages.h"

namespace heft {

namespace {
/// A question and the values that an answer can have: a touch's key and value, whatever the
/// language. The words are at KEY and KEY_VALUE of the page.
struct Question {
  std::string_view key;
  std::vector<std::string_view> values;
};

const std::array about_you{
    Question{"age", {"under_18", "18_24", "25_34", "35_44", "45_54", "55_or_more"}},
    Question{"gender", {"woman", "man", "other", "not_said"}},
    Question{"handedness", {"right", "left", "both"}},
    Question{"eyesight", {"unaided", "glasses", "lenses"}},
    Question{"ar_experience", {"never", "once_or_twice", "several_times", "often"}}};

const std::array how_decided{Question{"basis", {"seen", "felt", "both", "guessed"}},
                             Question{"certainty", {"very", "fairly", "little", "none"}},
                             Question{"movement", {"slow", "fast", "varied", "unaware"}}};

Touch entry(std::string_view key, std::string_view value) {
  Touch touch = touch_of(TouchKind::entry);
  touch.key = key;
  touch.value = value;
  return touch;
}

// @return the bottom of the question
float add_question(PageBuilder& builder, const std::string& page, const Question& question,
                   const std::string& progress) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const float y = builder.add_lines({fmt::format("{}   {}", builder.text(page, "title"), progress)},
                                    area.x, area.y, m.body, Tone::soft);
  const auto words = builder.typeface.fitted(builder.text(page, std::string(question.key)),
                                             0.7f * m.title, area.width, 2 * m.title);
  return builder.add_lines(words.lines, area.x, y + m.gap, words.size_px);
}

void add_choices(PageBuilder& builder, const std::string& page, const Question& question,
                 const std::string& chosen, float top) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const float width = (area.width - m.gap) / 2;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const std::string_view value = question.values[i];
    const Rect place{area.x + static_cast<float>(i % 2) * (width + m.gap),
                     top + static_cast<float>(i / 2) * (m.target + m.gap), width, m.target};
    const std::string name = fmt::format("{}_{}", question.key, value);
    builder
        .add_button(name, place, builder.text(page, name), entry(question.key, value),
                    static_cast<char>('1' + i))
        .chosen = value == chosen;
  }
}

void add_turning(PageBuilder& builder, int i, int n, bool answered) {
  const bool last = i + 1 == n;
  builder
      .add_button("next", builder.bottom_button(0),
                  builder.text("buttons", answered ? "next" : "skip"),
                  last ? Effect(touch_of(TouchKind::next)) : Effect(TurnPart{1}), key_enter)
      .look = answered ? Look::primary : Look::plain;
  if (i > 0)
    builder.add_button("back", builder.bottom_button(2), builder.text("buttons", "back"),
                       TurnPart{-1}, key_backspace);
}

void form_screen(PageBuilder& builder, const std::string& page, std::span<const Question> questions,
                 const ScreenMemory& memory) {
  const int n = static_cast<int>(questions.size());
  const int i = std::min(memory.part, n - 1);
  const Question& question = questions[static_cast<std::size_t>(i)];
  const auto chosen = memory.entries.find(std::string(question.key));
  const bool answered = chosen != memory.entries.end();
  const float bottom = add_question(builder, page, question, fmt::format("{} / {}", i + 1, n));
  add_choices(builder, page, question, answered ? chosen->second : "",
              bottom + builder.measures.gap);
  add_turning(builder, i, n, answered);
}
}  // namespace

void about_you_screen(PageBuilder& builder, const ScreenMemory& memory) {
  form_screen(builder, "about_you", about_you, memory);
}

void how_decided_screen(PageBuilder& builder, const ScreenMemory& memory) {
  form_screen(builder, "how_decided", how_decided, memory);
}

}  // namespace heft
