// One question of a questionnaire at a time, each to be skipped at will.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
// A question of the form in hand, and the room below its words.
class Asked {
 public:
  Asked(PageBuilder& on, const FormQuestion& asked, const std::string& answer)
      : builder(on), question(asked), given(answer) {}

  void add_answers(const Rect& room) {
    switch (question.kind) {
      case QuestionKind::choice:
        return add_choices(room);
      case QuestionKind::likert:
        return add_points(room);
      case QuestionKind::slider:
        return add_slider(room);
      case QuestionKind::number:
        return add_keypad(room);
      case QuestionKind::text:
        return;  // told to the experimenter
    }
  }

  /// Room that words take above the buttons, px.
  float above_px() const {
    const Measures& m = builder.measures;
    if (question.kind == QuestionKind::number) return Typeface::line_height_px(m.title);
    const bool has_ends =
        question.kind == QuestionKind::likert || question.kind == QuestionKind::slider;
    return has_ends ? ends_lines * m.body + m.gap : 0;
  }

  /// Rows of buttons that the answer takes.
  int n_rows() const {
    if (question.kind == QuestionKind::choice) return rows_of(n_choices(), n_columns());
    if (question.kind == QuestionKind::likert) return rows_of(n_points(), points_beside());
    return question.kind == QuestionKind::text ? 0 : 2;
  }

 private:
  static constexpr float ends_lines = 2.6f;
  static int rows_of(int n, int n_columns) { return (n + n_columns - 1) / n_columns; }
  int n_choices() const { return static_cast<int>(question.choices.size()); }
  int n_columns() const { return n_choices() <= 6 ? 2 : 4; }
  int n_points() const { return question.to - question.from + 1; }
  int points_beside() const {
    const Measures& m = builder.measures;
    const int most = static_cast<int>((builder.text_area().width + m.gap) / (m.target + m.gap));
    return n_points() <= most ? n_points() : (n_points() + 1) / 2;
  }

  // The i-th of a grid, in the direction of reading; scales and keypads run from the left.
  Rect cell(const Rect& room, int i, int n_beside, bool as_read) const {
    const float gap = builder.measures.gap, n = static_cast<float>(n_beside);
    const float width = (room.width - (n - 1) * gap) / n;
    int column = i % n_beside;
    if (as_read && builder.typeface.reads_right_to_left()) column = n_beside - 1 - column;
    const auto row = static_cast<float>(i / n_beside);
    return {room.x + static_cast<float>(column) * (width + gap),
            room.y + row * (builder.measures.target + gap), width, builder.measures.target};
  }

  Control& add_answer(const Rect& place, const std::string& words, const std::string& value) {
    Control& button = builder.add_button(question.key + '_' + value, place, words,
                                         builder.entry(question.key, value));
    button.chosen = value == given;
    return button;
  }

  void add_choices(const Rect& room) {
    for (int i = 0; i < n_choices(); ++i) {
      const AnswerChoice& choice = question.choices[static_cast<std::size_t>(i)];
      add_answer(cell(room, i, n_columns(), true), choice.text, choice.value);
    }
  }

  // The ends' words above the first and the last.
  float add_ends(const Rect& room) {
    const Measures& m = builder.measures;
    const bool leftward = builder.typeface.reads_right_to_left();
    const Rect half{room.x, room.y, room.width / 2 - m.gap, 0};
    const auto fitted = [&](const std::string& words) {
      return builder.typeface.fitted(words, m.body, half.width, ends_lines * m.body,
                                     m.least_px(m.body));
    };
    const FittedText first = fitted(question.low), last = fitted(question.high);
    const auto add = [&](const FittedText& words, bool left) {
      float y = room.y;
      for (const std::string& line : words.lines) {
        const float width = builder.typeface.width_px(line, words.size_px);
        const float x = left ? room.x : room.right() - width;
        builder.page.lines.push_back({line, x, y, words.size_px, Tone::soft});
        y += Typeface::line_height_px(words.size_px);
      }
      return y;
    };
    return std::max(add(first, !leftward), add(last, leftward)) + m.gap;
  }

  void add_points(const Rect& room) {
    const float y = add_ends(room);
    for (int i = 0; i < n_points(); ++i) {
      const std::string point = std::to_string(question.from + i);
      add_answer(cell({room.x, y, room.width, 0}, i, points_beside(), true), point, point);
    }
  }

  // A tap sets it; the two buttons below move it a little.
  void add_slider(const Rect& room) {
    const Measures& m = builder.measures;
    const float y = add_ends(room);
    const bool leftward = builder.typeface.reads_right_to_left();
    Control& scale = builder.add_button(question.key + "_scale", {room.x, y, room.width, m.target},
                                        "", Slide{builder.entry_key(question.key), leftward});
    scale.slide = Slid{std::nullopt};
    if (given.empty()) return;
    const int value = std::clamp(std::atoi(given.c_str()), 0, 100);
    scale.slide->fraction = static_cast<float>(leftward ? 100 - value : value) / 100;
    for (const int by : {-1, 1}) {
      const bool left = (by < 0) != leftward;
      const Rect place{left ? room.x : room.right() - m.target, y + m.target + m.gap, m.target,
                       m.target};
      builder.add_button(
          question.key + (by < 0 ? "_less" : "_more"), place, by < 0 ? "−" : "+",
          builder.entry(question.key, std::to_string(std::clamp(value + by, 0, 100))));
    }
  }

  // What was typed, and at the other end of its line the range.
  float add_typed(const Rect& room) {
    const Measures& m = builder.measures;
    const std::string range = fmt::format("{} – {}", question.least, question.most);
    builder.page.lines.push_back({range, room.right() - builder.typeface.width_px(range, m.body),
                                  room.y + m.title - m.body, m.body, Tone::soft});
    return builder.add_lines({given.empty() ? "–" : given}, room, room.y, m.title);
  }

  void add_keypad(const Rect& room) {
    constexpr std::array keys{"1", "2", "3", "4", "5", "6", "7", "8", "9", "0", "."};
    const Rect below{room.x, add_typed(room), room.width, 0};
    for (int i = 0; i < static_cast<int>(keys.size()); ++i) {
      const std::string key = keys[static_cast<std::size_t>(i)];
      const auto longer = typed_on(question, given, key);
      builder
          .add_button(question.key + "_key_" + key, cell(below, i, 6, false), key,
                      Typed{builder.entry_key(question.key), longer.value_or(given)})
          .enabled = longer.has_value();
    }
    builder
        .add_button(question.key + "_delete", cell(below, 11, 6, false), "←",
                    Typed{builder.entry_key(question.key),
                          given.substr(0, given.empty() ? 0 : given.size() - 1)})
        .enabled = !given.empty();
  }

  PageBuilder& builder;
  const FormQuestion& question;
  const std::string& given;
};

std::optional<std::string> value_of(const std::map<std::string, std::string>& values,
                                    const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

// A number is an answer when its question is left; one that is none yet, or below its range, is not
// left forward.
void leave_number(PageBuilder& builder, const FormQuestion& question, const std::string& told,
                  const std::string& given, bool answered) {
  const std::string number = given.ends_with('.') ? given.substr(0, given.size() - 1) : given;
  for (Control& control : builder.page.controls) {
    if (control.name != "next" && control.name != "back") continue;
    if (control.name == "next") control.enabled = answered || given.empty();
    if ((answered || given.empty()) && number != told)
      control.entered = builder.entry(question.key, number);
  }
}
}  // namespace

int first_open_question(const Questionnaire& form, const std::string& prefix,
                        const std::map<std::string, std::string>& entries) {
  const auto is_told = [](const FormQuestion& q) { return q.kind == QuestionKind::text; };
  const auto is_open = [&](const FormQuestion& question) {
    const auto given = entries.find(prefix + question.key);
    return !is_told(question) && (given == entries.end() || !takes_answer(question, given->second));
  };
  const auto& all = form.questions;
  auto open = std::ranges::find_if(all, is_open);
  if (open == all.end() && open != all.begin()) --open;
  while (open != all.begin() && is_told(*std::prev(open))) --open;  // perhaps not told yet
  return static_cast<int>(open - all.begin());
}

void questionnaire_screen(PageBuilder& builder) {
  const Questionnaire& form = builder.questionnaire();
  const Measures& m = builder.measures;
  const int n = static_cast<int>(form.questions.size());
  const int i = std::clamp(builder.memory.part, 0, n - 1);
  const FormQuestion& question = form.questions[static_cast<std::size_t>(i)];
  const std::string key = builder.entry_key(question.key);
  const std::string told = value_of(builder.memory.entries, key).value_or("");
  const std::string given = value_of(builder.memory.typed, key).value_or(told);
  Asked asked(builder, question, given);
  const Rect area = builder.text_area();
  float y = builder.add_lines({fmt::format("{}   {}/{}", form.title, i + 1, n)}, area, area.y,
                              m.body, Tone::soft);
  const auto rows = static_cast<float>(asked.n_rows());
  const float room_px =
      area.bottom() - y - rows * (m.target + m.gap) - asked.above_px() - 2 * m.gap;
  const FittedText words = builder.typeface.fitted(question.text, 0.7f * m.title, area.width,
                                                   room_px, m.least_px(0.7f * m.title));
  y = builder.add_lines(words.lines, area, y + m.gap, words.size_px) + m.gap;
  asked.add_answers({area.x, y, area.width, area.bottom() - y});
  const bool answered = question.kind == QuestionKind::text || takes_answer(question, given);
  add_turning(builder, i, n, answered);
  if (question.kind == QuestionKind::number) leave_number(builder, question, told, given, answered);
}

}  // namespace heft
