// Pages without a scene: texts and forms.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "base/Clock.h"
#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
using Lines = std::vector<std::string>;

/// Space for a part of a text.
struct Room {
  const PageBuilder& builder;
  float width_px, height_px;

  Lines lines(const std::string& text) const {
    return builder.typeface.wrapped(text, builder.measures.body, width_px);
  }
  bool holds(const std::string& text) const {
    return builder.height_px(lines(text), builder.measures.body) <= height_px;
  }
};

// A text with one more paragraph.
std::string joined(const std::string& text, const std::string& paragraph) {
  return text.empty() ? paragraph : text + "\n\n" + paragraph;
}

// Length of the sentences that end within the first n characters.
std::size_t whole_sentences(const std::string& text, std::size_t n) {
  std::size_t length = 0;
  for (const std::string_view mark : {". ", "? ", "! ", "。", "？", "！"})
    for (std::size_t at = text.find(mark); at < n; at = text.find(mark, at + 1))
      length = std::max(length, at + mark.size());
  return length;
}

// Length of the lines that are still free in a part.
std::size_t free_lines(const std::string& part, const std::string& paragraph, const Room& room) {
  std::size_t length = 0;
  for (const std::string& line : room.lines(paragraph)) {
    const std::size_t end = paragraph.find(line, length) + line.size();
    const bool alone = part.empty() && length == 0;  // it is shown even if it does not fit
    if (!alone && !room.holds(joined(part, paragraph.substr(0, end)))) break;
    length = end;
  }
  return length;
}

// Divides a paragraph that is longer than a part, and a sentence only if that is, too.
void add_divided(std::vector<std::string>& parts, std::string paragraph, const Room& room) {
  while (!room.holds(joined(parts.back(), paragraph))) {
    const std::size_t n_free = free_lines(parts.back(), paragraph, room);
    std::size_t length = whole_sentences(paragraph, n_free);
    if (length == 0 && parts.back().empty()) length = n_free;
    if (length > 0) parts.back() = joined(parts.back(), paragraph.substr(0, length));
    paragraph.erase(0, length);
    parts.emplace_back();
  }
  parts.back() = joined(parts.back(), paragraph);
}

// Divides a text into parts, between paragraphs where possible.
std::vector<std::string> in_parts(const std::string& text, const Room& room) {
  std::vector<std::string> parts(1);
  for (const std::string& paragraph : paragraphs_of(text)) {
    if (paragraph.empty()) continue;
    if (room.holds(joined(parts.back(), paragraph)))
      parts.back() = joined(parts.back(), paragraph);
    else if (room.holds(paragraph))
      parts.push_back(paragraph);
    else
      add_divided(parts, paragraph, room);
  }
  return parts;
}

void add_back(PageBuilder& builder) {
  builder.add_button("back", builder.bottom_button(2), builder.text("buttons", "back"),
                     TurnPart{-1}, key_backspace);
}

// The parts of a text. The last one has `n_rows` of buttons below it, the others one.
std::vector<std::string> parts_of(const PageBuilder& builder, const std::string& text,
                                  float above_px, int n_rows) {
  const auto room_over = [&](int n) {
    const Rect area = builder.text_area(n);
    return Room{builder, area.width, area.height - above_px};
  };
  std::vector<std::string> parts = in_parts(text, room_over(1));
  if (n_rows == 1) return parts;
  const std::string last = std::move(parts.back());
  parts.pop_back();
  for (std::string& part : in_parts(last, room_over(n_rows))) parts.push_back(std::move(part));
  return parts;
}

// Writes the title and a part of the text in the middle of the space above the buttons.
// @return whether it was the last part
// @param n_rows of buttons below the last part
bool add_text(PageBuilder& builder, const std::string& page, int wished_part, int n_rows = 1,
              const std::string& key = "text") {
  const Measures& m = builder.measures;
  const float width = builder.text_area().width;
  const Lines title = builder.typeface.wrapped(builder.text(page, "title"), m.title, width);
  const float title_px = builder.height_px(title, m.title) + m.margin;
  const auto parts = parts_of(builder, builder.text(page, key), title_px, n_rows);
  const int n_parts = static_cast<int>(parts.size());
  const int part = std::min(wished_part, n_parts - 1);
  const bool is_last = part + 1 == n_parts;
  const Lines lines =
      builder.typeface.wrapped(parts[static_cast<std::size_t>(part)], m.body, width);
  const Rect area = builder.text_area(is_last ? n_rows : 1);
  const float free_px = area.height - title_px - builder.height_px(lines, m.body);
  const float y = n_parts > 1 ? area.y : area.y + std::max(0.f, 0.4f * free_px);
  builder.add_lines(title, area, y, m.title);
  builder.add_lines(lines, area, y + title_px, m.body, Tone::soft);
  if (part > 0) add_back(builder);
  if (is_last) return true;
  builder.add_primary("more", builder.bottom_button(0), builder.text("buttons", "more"),
                      TurnPart{1});
  return false;
}

// Time left to wait; 0:00 only when nothing is left.
std::string time_left(double left_s) {
  return minutes_text(std::ceil(left_s));
}

void add_next(PageBuilder& builder, const std::string& word) {
  builder.add_primary("next", builder.bottom_button(0), builder.text("buttons", word),
                      touch_of(TouchKind::next));
}

void text_screen(PageBuilder& builder, const std::string& page, const std::string& next_word,
                 const std::string& key = "text") {
  if (add_text(builder, page, builder.memory.part, 1, key) && builder.state.wait_s <= 0)
    add_next(builder, next_word);
}

/// A question and its possible answers: a touch's key and value, the same in every language. The
/// texts have the keys KEY and KEY_VALUE of the page.
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

// Writes the question above its choices, at a size that leaves space for them.
// @return the bottom of the question
float add_question(PageBuilder& builder, const std::string& page, const Question& question,
                   const std::string& progress) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const float y = builder.add_lines({fmt::format("{}   {}", builder.text(page, "title"), progress)},
                                    area, area.y, m.body, Tone::soft);
  const auto n_rows = static_cast<float>((question.values.size() + 1) / 2);
  const float choices_px = n_rows * (m.target + m.gap) + 2 * m.gap;
  const auto words = builder.typeface.fitted(
      builder.text(page, std::string(question.key)), 0.7f * m.title, area.width,
      std::min(2 * m.title, area.bottom() - choices_px - y), m.least_px(0.7f * m.title));
  return builder.add_lines(words.lines, area, y + m.gap, words.size_px);
}

void add_choices(PageBuilder& builder, const std::string& page, const Question& question,
                 const std::string& chosen, float top) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const float width = (area.width - m.gap) / 2;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const std::string_view value = question.values[i];
    const bool left = (i % 2 == 0) != builder.typeface.reads_right_to_left();
    const Rect place{left ? area.x : area.right() - width,
                     top + static_cast<float>(i / 2) * (m.target + m.gap), width, m.target};
    const std::string name = fmt::format("{}_{}", question.key, value);
    builder
        .add_button(name, place, builder.text(page, name), entry_touch(question.key, value),
                    static_cast<char>('1' + i))
        .chosen = value == chosen;
  }
}

int first_open(std::span<const Question> questions,
               const std::map<std::string, std::string>& entries) {
  const auto open = std::ranges::find_if(
      questions, [&](const Question& q) { return !entries.contains(std::string(q.key)); });
  return std::min(static_cast<int>(open - questions.begin()),
                  static_cast<int>(questions.size()) - 1);
}

void form_screen(PageBuilder& builder, const std::string& page,
                 std::span<const Question> questions) {
  const int n = static_cast<int>(questions.size());
  const int i = std::min(builder.memory.part, n - 1);
  const Question& question = questions[static_cast<std::size_t>(i)];
  const auto chosen = builder.memory.entries.find(std::string(question.key));
  const bool answered = chosen != builder.memory.entries.end();
  const float bottom = add_question(builder, page, question, fmt::format("{}/{}", i + 1, n));
  add_choices(builder, page, question, answered ? chosen->second : "",
              bottom + builder.measures.gap);
  add_turning(builder, i, n, answered);
}

// Minimum time on the last part of the consent text: 20 ms per letter, which is 10 words a second,
// and at least 2 s.
double reading_time_s(const PageBuilder& builder) {
  constexpr double glance_s = 2, letter_s = 0.02;
  std::size_t n = 0;
  for (const TextLine& line : builder.page.lines) n += line.text.size();
  return std::max(glance_s, letter_s * static_cast<double>(n));
}
}  // namespace

void add_turning(PageBuilder& builder, int i, int n, bool answered) {
  const bool last = i + 1 == n;
  builder
      .add_button("next", builder.bottom_button(0),
                  builder.text("buttons", answered ? "next" : "skip"),
                  last ? Effect(touch_of(TouchKind::next)) : Effect(TurnPart{1}), key_enter)
      .look = answered ? Look::primary : Look::plain;
  if (i > 0) add_back(builder);
}

// "More" and "agree" are at different places, so that reading on cannot agree. Declining needs no
// reading time, nor does the confirmation.
void consent_screen(PageBuilder& builder) {
  if (!add_text(builder, "consent", builder.memory.part, 2)) return;
  const double left_s =
      builder.memory.has_declined ? 0 : reading_time_s(builder) - builder.memory.up_s;
  Control& agree = builder.add_primary("next", builder.choice_button(0),
                                       builder.text("consent", "agree"), touch_of(TouchKind::next));
  agree.enabled = left_s <= 0;
  if (!agree.enabled)
    agree.note = fmt::format("{} {}", builder.text_if_any("consent", "reading"), time_left(left_s));
  builder.add_button("decline", builder.choice_button(1), builder.text("consent", "decline"),
                     touch_of(TouchKind::decline), 'n');
}

void declined_screen(PageBuilder& builder) {
  if (!add_text(builder, "declined", builder.memory.part)) return;
  builder.add_button("next", builder.bottom_button(0), builder.text("declined", "take_back"),
                     touch_of(TouchKind::next));
  builder.add_button("decline", builder.bottom_button(1), builder.text("declined", "leave"),
                     touch_of(TouchKind::decline), 'n');
}

int first_open_question(const ScreenState& state) {
  if (state.screen == Screen::about_you) return first_open(about_you, state.entries);
  if (state.screen == Screen::how_decided) return first_open(how_decided, state.entries);
  return 0;
}

void welcome_screen(PageBuilder& builder) {
  text_screen(builder, "welcome", "start");
}

void instructions_screen(PageBuilder& builder) {
  text_screen(builder, text_page(Screen::instructions, builder.state.task), "next",
              instructions_key(builder.state.wording));
}

void rest_screen(PageBuilder& builder) {
  if (!add_text(builder, "rest", builder.memory.part)) return;
  if (builder.state.wait_s <= 0) return add_next(builder, "next");
  const Rect area = builder.bottom_button(0);
  const Rect column = builder.text_area();
  const Measures& m = builder.measures;
  const float height_px = Typeface::line_height_px(m.body + m.title);
  const float top = std::min(area.y, m.height - m.margin - height_px);
  const float y =
      builder.add_lines({builder.text("rest", "time_left")}, column, top, m.body, Tone::soft);
  builder.add_lines({time_left(builder.state.wait_s)}, column, y, m.title);
}

void paused_screen(PageBuilder& builder) {
  add_text(builder, "paused", builder.memory.part);
}

void thanks_screen(PageBuilder& builder) {
  text_screen(builder, "thanks", "finish");
}

void setting_up_screen(PageBuilder& builder) {
  const Measures& m = builder.measures;
  const Rect area = builder.text_area();
  const auto lines = [&](const char* key, float size_px) {
    return builder.typeface.wrapped(builder.text_if_any("setting_up", key), size_px, area.width);
  };
  const float y = builder.add_lines(lines("title", m.title), area, 0.3f * m.height, m.title);
  builder.add_lines(lines("text", m.body), area, y + m.margin, m.body, Tone::soft);
}

void about_you_screen(PageBuilder& builder) {
  form_screen(builder, "about_you", about_you);
}

void how_decided_screen(PageBuilder& builder) {
  form_screen(builder, "how_decided", how_decided);
}

}  // namespace heft
