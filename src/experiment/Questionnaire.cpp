#include "experiment/Questionnaire.h"

#include <algorithm>
#include <charconv>

namespace heft {

bool takes_answer(const FormQuestion& question, const std::string& value) {
  if (question.kind != QuestionKind::number) return !value.empty();
  double number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  return error == std::errc() && stop == end && number >= question.least && number <= question.most;
}

}  // namespace heft
