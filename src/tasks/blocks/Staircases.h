// The interleaved procedures of a block: which one is next, their responses and duration. Tasks
// define what a trial shows at a level, and which response an answer is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/Rows.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/Procedure.h"
#include "tasks/blocks/BlockKeys.h"

namespace heft {

/// A procedure of a block, and its reference.
struct ReferenceStaircase {
  double reference_g = 0;   ///< 0: none, the level is a mass
  Procedure staircase;      ///< before its first trial; levels in g: comparison - reference
  std::string condition{};  ///< technique; empty: the block's
};

/// Rules for the procedures of a block that follow from its answers.
struct StaircaseRules {
  enum class Reference { required, optional, unknown };  ///< unknown: its mass is a mistake
  Reference reference = Reference::required;
  std::optional<double> object_g = {};  ///< of the real object that is the reference of all
  bool either_sign = false;             ///< the comparison may be lighter
  std::string_view no_cube = {};  ///< the key that makes answers name no cube; empty: they name one
};

/// A block for the functions that read and check its procedures, which depends on its answers.
template <typename Block>
struct StaircasesOf {
  Block& block;
};
template <typename Block>
StaircasesOf(Block&) -> StaircasesOf<Block>;

/// Expected number of trials. Procedures whose length depends on the answers are simulated; of
/// Bayesian kinds it is the largest.
/// @param is_forced every answer names a cube
double expected_trials(std::span<const ReferenceStaircase> staircases, bool is_forced);

/// Whether the number of trials depends on the answers.
bool depend_on_answers(std::span<const ReferenceStaircase> staircases);

/// The order of the procedures, for reports.
std::string in_words(const InterleaveConfig& interleaving);
/// Adds each procedure's description, and its start and steps, if it has steps.
void add_staircases(Choices& choices, std::span<const ReferenceStaircase> staircases);

/// The procedures of a block while it runs.
class RunningStaircases {
 public:
  RunningStaircases(const std::vector<ReferenceStaircase>& staircases,
                    const InterleaveConfig& interleaving);

  bool finished() const;
  /// Index of the one that the next trial belongs to. Undefined once finished.
  std::size_t next(RandomStream& stream) const;
  /// Index of an unfinished one, all equally likely.
  std::size_t drawn_unfinished(RandomStream& stream) const;
  const Procedure& operator[](std::size_t index) const { return staircases_[index]; }

  /// Folds the response to a completed trial, whose plan names its staircase.
  void respond(const TrialRow& row, const Response& response, Changes& changes);
  /// The last unfinished one of several; none while more are running.
  std::optional<std::string> unfinished_staircase() const;

 private:
  std::vector<Procedure> staircases_;  // in the order of the block's
  InterleaveConfig interleaving_;
  std::optional<std::size_t> previous_;  // of the last completed trial with a staircase
};

}  // namespace heft
