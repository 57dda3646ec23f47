#include "responders/decision/Questions.h"

#include <fmt/format.h>

#include <cmath>

#include "base/Random.h"

namespace heft {

namespace {
std::string any_whole_number(double least, double most, RandomStream& stream) {
  const double from = std::ceil(least), n = std::floor(most) - from + 1;
  if (n < 1) return fmt::format("{}", least);
  return fmt::format("{:.0f}",
                     from + static_cast<double>(stream.below(static_cast<std::uint64_t>(n))));
}
}  // namespace

std::optional<std::string> any_answer_to(const FormQuestion& question, std::uint64_t seed,
                                         const std::string& key) {
  RandomStream stream(seed, "questionnaire " + key);
  switch (question.kind) {
    case QuestionKind::choice:
      return question.choices.at(stream.below(question.choices.size())).value;
    case QuestionKind::likert:
      return any_whole_number(question.from, question.to, stream);
    case QuestionKind::slider:
      return any_whole_number(0, 100, stream);
    case QuestionKind::number:
      return any_whole_number(question.least, question.most, stream);
    case QuestionKind::text:
      break;
  }
  return std::nullopt;
}

}  // namespace heft
