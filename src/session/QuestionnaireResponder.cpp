#include "session/QuestionnaireResponder.h"

namespace heft {

namespace {
constexpr double reading_s = 3;  // per question
}

QuestionnaireResponder::QuestionnaireResponder(const Responder& mind, const Questionnaire& form,
                                               const ScreenState& screen) {
  double at_s = 0;
  const auto add = [&](TouchKind kind, const std::string& key, const std::string& value) {
    Touch touch;
    touch.kind = kind;
    touch.key = key;
    touch.value = value;
    touch.page = screen.page();
    touches_.push_back(touch);
    at_s_.push_back(at_s);
  };
  for (const FormQuestion& question : form.questions) {
    const std::string key = screen.form_prefix + question.key;
    const auto given = screen.entries.find(key);
    if (given != screen.entries.end() && takes_answer(question, given->second)) continue;
    at_s += reading_s;
    if (const auto value = mind.answer(question, key); value && takes_answer(question, *value))
      add(TouchKind::entry, key, *value);
  }
  add(TouchKind::next, "", "");
}

std::vector<Touch> QuestionnaireResponder::touch(double elapsed_s) {
  std::vector<Touch> touches;
  for (; n_given_ < touches_.size() && at_s_[n_given_] <= elapsed_s; ++n_given_)
    touches.push_back(touches_[n_given_]);
  return touches;
}

}  // namespace heft
