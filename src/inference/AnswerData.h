// Files of answers and their fits: CSV with a header, columns in any order, others ignored.
// Psychometric: columns x, n_positive and n, or a row a trial with x and response (0 or 1).
// Indecision: level_g and answer (comparison, reference, none). `person` or `participant` names who
// answered.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inference/MixedIndecision.h"
#include "inference/checks/GoodnessOfFit.h"

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

/// How to fit, in the words of `heft fit`; none: its default.
struct FitRequest {
  std::string model;                                ///< of FitModel
  std::optional<std::string> function{}, scale{};   ///< of PsychometricShape, LevelScale
  std::optional<std::string> guess{}, lapse{};      ///< "free" or a number
  std::optional<std::string> group_by{}, person{};  ///< columns
};

/// The fit of one group.
struct NamedFit {
  std::optional<std::string> group;
  Fit fit;
  std::map<std::string, OwnThreshold> people{};  ///< of a mixed fit
  GoodnessOfFit goodness{};
};

struct FittedAnswers {
  std::vector<NamedFit> fits;
  std::string warning;  ///< people are pooled; empty: there is nothing to warn of
};

/// One fit for each group; with `person` the mixed model of heft analyse, in which people differ.
/// @throws Error (usage) for options that are wrong or don't suit each other; as parse_answers
FittedAnswers fit_answers(std::string_view text, const std::string& file,
                          const FitRequest& request);

}  // namespace heft
