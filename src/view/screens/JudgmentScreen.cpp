// The screen of a judgment, and what it shares with magnitude estimation: a question beside the
// scene.
#include <string>

#include "tasks/Judgment.h"
#include "view/screens/AskedQuestion.h"
#include "view/screens/ScreenPages.h"

namespace heft {

void add_confirmation(PageBuilder& builder, const std::string& words, const Action& action,
                      bool enabled) {
  const Rect row = bottom_row(builder);
  const float gap = builder.measures.gap;
  Control& button = builder.add_button(std::string(action.kind), cell(row, 0, 2, gap), words,
                                       answer_touch(action), key_enter);
  button.look = Look::primary;
  button.enabled = enabled && can_answer(builder);
  add_put_back(builder, cell(row, 1, 2, gap));
}

void add_question(PageBuilder& builder, const FormQuestion& question, const std::string& confirm,
                  const std::function<Action(const std::string& given)>& action) {
  const Rect column = column_of(builder);
  const float height = bottom_row(builder).y - column.y - builder.measures.gap;
  const auto typed = builder.memory.typed.find(builder.entry_key(question.key));
  const std::string given = typed == builder.memory.typed.end() ? "" : typed->second;
  AskedQuestion(builder, question, given, AskedIn::trial)
      .add_answers({column.x, column.y, column.width, height});
  for (Control& control : builder.page.controls) control.enabled &= can_answer(builder);
  add_confirmation(builder, confirm, action(given), takes_answer(question, given));
}

void Judgment::screen(PageBuilder& builder, const Offer& offer) {
  const FormQuestion& question = offer.question;
  add_scene(builder, question.text);
  add_hint(builder);
  add_question(builder, question, builder.text(trial_page(builder), "validate"),
               [&](const std::string& given) -> Action {
                 return {"judge", {}, {}, number_of(question, given)};
               });
}

}  // namespace heft
