// Files of answers for a fit: CSV with a header. Psychometric: columns x, n_positive and n, or a
// row a trial with x and response (0 or 1). Indecision: level_g and answer (comparison, reference,
// none). Columns stand in any order, and others may stand beside them; `person` or `participant`
// says who answered.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inference/MixedIndecision.h"

namespace heft {

enum class FitModel { psychometric, indecision };
template <>
struct EnumNames<FitModel> {
  static constexpr std::array<std::string_view, 2> names{"psychometric", "indecision"};
};

struct AnswerGroup {
  std::optional<std::string> name;  ///< the text in the column that groups; none: there is none
  AnswersByLevel answers;           ///< of levels that were shown
  AnswersByPerson people{};         ///< the same, where a column says who answered
};

struct AnswerFormat {
  FitModel model = FitModel::psychometric;
  std::optional<std::string> group_by{};  ///< a column's name
  bool takes_logarithm = false;           ///< levels below 0 are refused
  /// The column of who answered. None: `person` or `participant`, if there is one.
  std::optional<std::string> person{};
};

/// Groups in the order of their first rows; one without a name where nothing groups.
/// @throws InvalidFile naming wrong rows, each with its place and what was expected; Error (usage)
///   when there is no column to group by
std::vector<AnswerGroup> parse_answers(std::string_view text, const std::string& file,
                                       const AnswerFormat& format);

/// @throws Error when the file can't be read, as parse_answers
std::vector<AnswerGroup> load_answers(const std::string& path, const AnswerFormat& format);

}  // namespace heft
