// What a session consists of: blocks of trials, breaks and demonstrations, as a protocol says. The
// engine folds over these and needs nothing else of a protocol.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/DefaultTechniques.h"
#include "experiment/Task.h"
#include "psychophysics/Interleaving.h"

namespace heft {

/// After a wrong answer in the introduction: the same cubes again, or newly shuffled ones.
enum class WrongAnswer { same_layout, reshuffle };
template <>
struct EnumNames<WrongAnswer> {
  static constexpr std::array<std::string_view, 2> names{"same_layout", "reshuffle"};
};

enum class SortingOrders { random, balanced };
template <>
struct EnumNames<SortingOrders> {
  static constexpr std::array<std::string_view, 2> names{"random", "balanced"};
};

/// What counts as a positive answer of a comparison (moves the staircase down).
enum class PositiveAnswer { any_choice, correct_choice };
template <>
struct EnumNames<PositiveAnswer> {
  static constexpr std::array<std::string_view, 2> names{"any_choice", "correct_choice"};
};

/// Where the reference of a comparison stands: a coin a trial, or as often left as right in every
/// four trials of a staircase (and of the catch trials), in random order.
enum class Sides { random, balanced };
template <>
struct EnumNames<Sides> {
  static constexpr std::array<std::string_view, 2> names{"random", "balanced"};
};

struct DemonstrationBlock {
  std::string name;
  double duration_s = 20;
};

struct IntroductionBlock {
  std::string name;
  std::vector<double> masses_g;              ///< two; shuffled
  std::string condition = spring_technique;  ///< name of the technique
  WrongAnswer wrong_answer = WrongAnswer::same_layout;
};

/// So many trials of a sorting block are rendered with this technique.
struct TechniqueTrials {
  std::string technique;
  int trials = 0;
};

struct SortingBlock {
  std::string name;
  std::vector<double> masses_g;  ///< two to six
  std::vector<TechniqueTrials> trials{{coupled_technique, 5}, {spring_technique, 5}};
  int max_run = 0;  ///< longest run of one technique; 0: any
  SortingOrders orders = SortingOrders::random;

  int n_trials() const {
    int n = 0;
    for (const TechniqueTrials& some : trials) n += some.trials;
    return n;
  }
};

/// One procedure of a comparison block and the reference it compares with.
struct ReferenceStaircase {
  double reference_g = 0;
  Procedure staircase;      ///< before its first trial; levels are comparison - reference, g
  std::string condition{};  ///< its own technique; empty: the block's
};

/// So many trials of a comparison block compare a reference with its equal.
struct ReferenceCatchTrials {
  double reference_g = 0;
  int trials = 0;
};

struct ComparisonBlock {
  std::string name;
  std::string condition = spring_technique;  ///< name of the technique
  // Catch trials, of difference 0, drive no staircase: either each trial is one by a coin, or there
  // are so many, one somewhere in every `catch_every` trials and none among the first three; those
  // left over come after the last staircase.
  double catch_fraction = 0;
  std::vector<ReferenceCatchTrials> catch_trials;
  int catch_every = 7;
  Sides sides = Sides::random;
  PositiveAnswer positive_answer = PositiveAnswer::any_choice;
  InterleaveConfig interleaving;
  std::vector<ReferenceStaircase> staircases;
};

struct BreakBlock {
  std::string name;
  double least_duration_s = 60;
};

using Block =
    std::variant<DemonstrationBlock, IntroductionBlock, SortingBlock, ComparisonBlock, BreakBlock>;

inline const std::string& block_name(const Block& block) {
  return std::visit([](const auto& of_kind) -> const std::string& { return of_kind.name; }, block);
}

/// When a trial may begin and be answered: the second tap of two must meet nothing that it could
/// answer. What is in force is told in the session's setup.
struct Onset {
  double gap_s = 0.6;         ///< from a trial's end to the next one's start
  double min_answer_s = 0.5;  ///< from a trial's cubes to the first answer that is taken
};

/// All that decides which trial comes next and which answers are taken.
struct SessionPlan {
  std::vector<Block> blocks;
  bool require_contact = false;  ///< refuse answers until every cube was touched
};

}  // namespace heft
