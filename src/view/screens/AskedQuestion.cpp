#include "view/screens/AskedQuestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace heft {

namespace {
constexpr float ends_lines = 2.6f;

int rows_of(int n, int n_columns) {
  return (n + n_columns - 1) / n_columns;
}
}  // namespace

void AskedQuestion::add_answers(const Rect& area) {
  switch (question.kind) {
    case QuestionKind::choice:
      return add_choices(area);
    case QuestionKind::likert:
      return add_points(area);
    case QuestionKind::slider:
      return add_slider(area);
    case QuestionKind::number:
      return add_keypad(area);
    case QuestionKind::text:
      return;  // answered to the experimenter
  }
}

float AskedQuestion::above_px() const {
  const Measures& m = builder.measures;
  if (question.kind == QuestionKind::number) return Typeface::line_height_px(m.title);
  const bool has_ends =
      question.kind == QuestionKind::likert || question.kind == QuestionKind::slider;
  return has_ends ? ends_lines * m.body + m.gap : 0;
}

int AskedQuestion::n_rows() const {
  if (question.kind == QuestionKind::choice) return rows_of(n_choices(), choices_beside());
  if (question.kind == QuestionKind::likert) return rows_of(n_points(), points_beside());
  if (question.kind == QuestionKind::number) return rows_of(12, keys_beside());
  return question.kind == QuestionKind::text ? 0 : 2;
}

int AskedQuestion::choices_beside() const {
  if (in_trial) return rows_of(n_choices(), 4);
  return n_choices() <= 6 ? 2 : 4;
}

int AskedQuestion::points_beside() const {
  if (in_trial) return 3;
  const Measures& m = builder.measures;
  const int most = static_cast<int>((builder.text_area().width + m.gap) / (m.target + m.gap));
  return n_points() <= most ? n_points() : (n_points() + 1) / 2;
}

// The i-th cell of a grid, in reading direction; scales and keypads always start at the left.
Rect AskedQuestion::cell(const Rect& area, int i, int n_beside, bool as_read) const {
  const float gap = builder.measures.gap, n = static_cast<float>(n_beside);
  const float width = (area.width - (n - 1) * gap) / n;
  int column = i % n_beside;
  if (as_read && builder.typeface.reads_right_to_left()) column = n_beside - 1 - column;
  const auto row = static_cast<float>(i / n_beside);
  return {area.x + static_cast<float>(column) * (width + gap),
          area.y + row * (builder.measures.target + gap), width, builder.measures.target};
}

Effect AskedQuestion::entering(const std::string& value) const {
  if (in_trial) return Typed{builder.entry_key(question.key), value};
  return builder.entry(question.key, value);
}

Control& AskedQuestion::add_answer(const Rect& place, const std::string& words,
                                   const std::string& value) {
  Control& button = builder.add_button(question.key + '_' + value, place, words, entering(value));
  button.chosen = value == given;
  return button;
}

void AskedQuestion::add_choices(const Rect& area) {
  for (int i = 0; i < n_choices(); ++i) {
    const AnswerChoice& choice = question.choices[static_cast<std::size_t>(i)];
    add_answer(cell(area, i, choices_beside(), true), choice.text, choice.value);
  }
}

// The labels of the ends above the first and the last button; where these are in several rows, with
// the numbers that they belong to.
float AskedQuestion::add_ends(const Rect& area) {
  const Measures& m = builder.measures;
  const float rows_px = static_cast<float>(n_rows()) * (m.target + m.gap);
  const float most_px = std::min(ends_lines * m.body, area.height - rows_px);
  const bool numbered = question.kind == QuestionKind::likert && n_rows() > 1;
  const auto words_at = [&](int point, const std::string& words) {
    return numbered ? fmt::format("{} = {}", point, words) : words;
  };
  const bool leftward = builder.typeface.reads_right_to_left();
  const Rect half{area.x, area.y, area.width / 2 - m.gap, 0};
  const auto fitted = [&](const std::string& words) {
    return builder.typeface.fitted(words, m.body, half.width, most_px, m.least_px(m.body));
  };
  const FittedText first = fitted(words_at(question.from, question.low)),
                   last = fitted(words_at(question.to, question.high));
  const auto add = [&](const FittedText& words, bool left) {
    float y = area.y;
    for (const std::string& line : words.lines) {
      const float width = builder.typeface.width_px(line, words.size_px);
      const float x = left ? area.x : area.right() - width;
      builder.page.lines.push_back({line, x, y, words.size_px, Tone::soft});
      y += Typeface::line_height_px(words.size_px);
    }
    return y;
  };
  return std::max(add(first, !leftward), add(last, leftward)) + m.gap;
}

void AskedQuestion::add_points(const Rect& area) {
  const float y = add_ends(area);
  for (int i = 0; i < n_points(); ++i) {
    const std::string point = std::to_string(question.from + i);
    add_answer(cell({area.x, y, area.width, 0}, i, points_beside(), true), point, point);
  }
}

// A tap sets the slider; the two buttons below move it slightly.
void AskedQuestion::add_slider(const Rect& area) {
  const Measures& m = builder.measures;
  const float y = add_ends(area);
  const bool leftward = builder.typeface.reads_right_to_left();
  Control& scale =
      builder.add_button(question.key + "_scale", {area.x, y, area.width, m.target}, "",
                         Slide{builder.entry_key(question.key), leftward, in_trial});
  scale.slide = SliderValue{std::nullopt};
  if (given.empty()) return;
  const int value = std::clamp(std::atoi(given.c_str()), 0, 100);
  scale.slide->fraction = static_cast<float>(leftward ? 100 - value : value) / 100;
  for (const int by : {-1, 1}) {
    const bool left = (by < 0) != leftward;
    const Rect place{left ? area.x : area.right() - m.target, y + m.target + m.gap, m.target,
                     m.target};
    builder.add_button(question.key + (by < 0 ? "_less" : "_more"), place, by < 0 ? "−" : "+",
                       entering(std::to_string(std::clamp(value + by, 0, 100))));
  }
}

// The typed number, and the range at the other end of its line; both smaller where large texts
// would meet.
float AskedQuestion::add_typed(const Rect& area) {
  const Measures& m = builder.measures;
  const std::string range = fmt::format("{} – {}", question.least, question.most);
  const auto width_px = [&](const std::string& text, float size_px) {
    return builder.typeface.width_px(text, size_px);
  };
  const float number_px =
      std::max(width_px(given, m.title), width_px(fmt::format("{}", question.most), m.title));
  const float fits = (area.width - 2 * m.gap) / (number_px + width_px(range, m.body));
  const float number_size = std::min(fits, 1.f) * m.title, size = std::min(fits, 1.f) * m.body;
  builder.page.lines.push_back(
      {range, area.right() - width_px(range, size), area.y + number_size - size, size, Tone::soft});
  builder.add_lines({given.empty() ? "–" : given}, area, area.y, number_size);
  return area.y + Typeface::line_height_px(m.title);
}

void AskedQuestion::add_keypad(const Rect& area) {
  constexpr std::array keys{"1", "2", "3", "4", "5", "6", "7", "8", "9", "0", "."};
  const Rect below{area.x, add_typed(area), area.width, 0};
  for (int i = 0; i < static_cast<int>(keys.size()); ++i) {
    const std::string key = keys[static_cast<std::size_t>(i)];
    const auto longer = typed_on(question, given, key);
    builder
        .add_button(question.key + "_key_" + key, cell(below, i, keys_beside(), false), key,
                    Typed{builder.entry_key(question.key), longer.value_or(given)})
        .enabled = longer.has_value();
  }
  builder
      .add_button(question.key + "_delete", cell(below, 11, keys_beside(), false), "←",
                  Typed{builder.entry_key(question.key),
                        given.substr(0, given.empty() ? 0 : given.size() - 1)})
      .enabled = !given.empty();
}

}  // namespace heft
