#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "tasks/Estimation.h"
#include "view/screens/AskedQuestion.h"
#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
constexpr auto page = "trial_estimation";

// The question: the questionnaire's or the page's text, and the standard's number.
std::string asked_words(const PageBuilder& builder, const Estimation::Offer& offer) {
  if (offer.is_standard)
    return fmt::format("{} {:g}.", builder.text(page, "standard"), offer.modulus->value);
  if (!offer.question.text.empty()) return offer.question.text;
  const std::string& question = builder.text(page, "question");
  if (!offer.modulus) return question;
  return fmt::format("{} {} {:g}.", question, builder.text(page, "standard_was"),
                     offer.modulus->value);
}

// The number of an answer; for a choice its place among the choices, from 1.
double value_of(const FormQuestion& question, const std::string& given) {
  if (question.kind != QuestionKind::choice) return std::strtod(given.c_str(), nullptr);
  const auto chosen = std::ranges::find(question.choices, given, &AnswerChoice::value);
  return static_cast<double>(chosen - question.choices.begin()) + 1;
}

FormQuestion in_words(const PageBuilder& builder, const Estimation::Offer& offer) {
  FormQuestion question = offer.question;
  if (question.key.empty()) question.key = "value";
  if (question.kind == QuestionKind::slider && question.low.empty()) {
    question.low = builder.text(page, "lightest");
    question.high = builder.text(page, "heaviest");
  }
  return question;
}

void add_last(PageBuilder& builder, const std::string& name, const std::string& words,
              const Action& action, bool enabled) {
  const Rect row = bottom_row(builder);
  const float gap = builder.measures.gap;
  Control& button =
      builder.add_button(name, cell(row, 0, 2, gap), words, answer_touch(action), key_enter);
  button.look = Look::primary;
  button.enabled = enabled && can_answer(builder);
  add_put_back(builder, cell(row, 1, 2, gap));
}
}  // namespace

void Estimation::screen(PageBuilder& builder, const Offer& offer) {
  add_scene(builder, asked_words(builder, offer));
  add_hint(builder);
  const Rect column = column_of(builder);
  if (offer.is_standard) {  // its number is displayed where answers will be typed
    builder.add_lines({fmt::format("{:g}", offer.modulus->value)}, column, column.y,
                      builder.measures.title);
    return add_last(builder, "validate", builder.text("buttons", "next"), {"validate"}, true);
  }
  const FormQuestion question = in_words(builder, offer);
  const auto typed = builder.memory.typed.find(builder.entry_key(question.key));
  const std::string given = typed == builder.memory.typed.end() ? "" : typed->second;
  AskedQuestion(builder, question, given, AskedIn::trial)
      .add_answers({column.x, column.y, column.width, column.height});
  for (Control& control : builder.page.controls) control.enabled &= can_answer(builder);
  add_last(builder, "estimate", builder.text(page, "validate"),
           {"estimate", {}, {}, value_of(question, given)}, takes_answer(question, given));
}

}  // namespace heft
