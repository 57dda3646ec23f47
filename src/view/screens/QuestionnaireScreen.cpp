// Shows one question of a questionnaire at a time; each can be skipped.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "view/screens/AskedQuestion.h"

namespace heft {

namespace {
std::optional<std::string> value_of(const std::map<std::string, std::string>& values,
                                    const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

// A typed number becomes an answer when its question is left. An incomplete number, or one below
// its range, blocks the way forward.
void leave_number(PageBuilder& builder, const FormQuestion& question, const std::string& reported,
                  const std::string& given, bool answered) {
  const std::string number = given.ends_with('.') ? given.substr(0, given.size() - 1) : given;
  for (Control& control : builder.page.controls) {
    if (control.name != "next" && control.name != "back") continue;
    if (control.name == "next") control.enabled = answered || given.empty();
    if ((answered || given.empty()) && number != reported)
      control.entered = builder.entry(question.key, number);
  }
}
}  // namespace

int first_open_question(const Questionnaire& form, const std::string& prefix,
                        const std::map<std::string, std::string>& entries) {
  const auto is_spoken = [](const FormQuestion& q) { return q.kind == QuestionKind::text; };
  const auto is_open = [&](const FormQuestion& question) {
    const auto given = entries.find(prefix + question.key);
    return !is_spoken(question) &&
           (given == entries.end() || !takes_answer(question, given->second));
  };
  const auto& all = form.questions;
  auto open = std::ranges::find_if(all, is_open);
  if (open == all.end() && open != all.begin()) --open;
  // The experimenter may not have typed the answers to spoken questions just before it yet.
  while (open != all.begin() && is_spoken(*std::prev(open))) --open;
  return static_cast<int>(open - all.begin());
}

void questionnaire_screen(PageBuilder& builder) {
  const Questionnaire& form = builder.questionnaire();
  const Measures& m = builder.measures;
  const int n = static_cast<int>(form.questions.size());
  const int i = std::clamp(builder.memory.part, 0, n - 1);
  const FormQuestion& question = form.questions[static_cast<std::size_t>(i)];
  const std::string key = builder.entry_key(question.key);
  const std::string reported = value_of(builder.memory.entries, key).value_or("");
  const std::string given = value_of(builder.memory.typed, key).value_or(reported);
  AskedQuestion asked(builder, question, given, AskedIn::form);
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
  if (question.kind == QuestionKind::number)
    leave_number(builder, question, reported, given, answered);
}

}  // namespace heft
