#include "experiment/ScreenTexts.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace heft {

bool takes_answer(const FormQuestion& question, const std::string& value) {
  if (question.kind != QuestionKind::number) return !value.empty();
  double number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  return error == std::errc() && stop == end && number >= question.least && number <= question.most;
}

namespace {
// Whether more digits can bring the number into the range. With further digits before the point,
// the typed text is the start of all numbers in [low, low + width), each ten times the previous.
bool can_become_answer(const FormQuestion& question, const std::string& typed) {
  if (typed.size() >= longest_number) return takes_answer(question, typed);
  double low = 0;
  std::from_chars(typed.data(), typed.data() + typed.size(), low);
  const auto point = typed.find('.');
  const bool is_whole = point == std::string::npos;
  double width = is_whole ? 1 : std::pow(10, -static_cast<double>(typed.size() - point - 1));
  const std::size_t n_more = is_whole && low > 0 ? longest_number - typed.size() : 0;
  for (std::size_t i = 0; i <= n_more && low <= question.most; ++i, low *= 10, width *= 10)
    if (low + width > question.least) return true;
  return false;
}
}  // namespace

std::optional<std::string> typed_on(const FormQuestion& question, const std::string& typed,
                                    const std::string& key) {
  std::string longer = typed == "0" && key != "." ? key : typed + key;
  if (longer == ".") longer = "0.";
  const bool is_number = longer.find('.') == longer.rfind('.');
  if (!is_number || longer.size() > longest_number || !can_become_answer(question, longer))
    return std::nullopt;
  return longer;
}

}  // namespace heft
