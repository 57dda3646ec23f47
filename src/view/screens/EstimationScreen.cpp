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

}  // namespace

void Estimation::screen(PageBuilder& builder, const Offer& offer) {
  add_scene(builder, asked_words(builder, offer));
  add_hint(builder);
  if (offer.is_standard) {  // its number is displayed where answers will be typed
    const Rect column = column_of(builder);
    builder.add_lines({fmt::format("{:g}", offer.modulus->value)}, column, column.y,
                      builder.measures.title);
    return add_confirmation(builder, builder.text("buttons", "next"), {"validate"}, true);
  }
  const FormQuestion question = in_words(builder, offer);
  add_question(builder, question, builder.text(page, "validate"),
               [&](const std::string& given) -> Action {
                 return {"estimate", {}, {}, value_of(question, given)};
               });
}

}  // namespace heft
