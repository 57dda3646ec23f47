// From percepts to an answer: memory, criterion, guesses and lapses. Independent of frames and
// screens.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/Random.h"
#include "experiment/ScreenTexts.h"
#include "responders/Responder.h"
#include "responders/ResponderParameters.h"

namespace heft {

class Decision {
 public:
  Decision(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial);

  /// What the trial offers now.
  void offer(const std::any& offered) { offer_ = offered; }

  /// A real object that is lifted is felt with the noise of memory and judgment alone, and compared
  /// with what is seen by mm_per_g.
  /// @param percepts_mm by cube, leftmost first
  /// @param wrong_slots incorrect choices so far, oldest first, if the task asks again
  Answer decide(std::span<const double> percepts_mm, std::span<const int> wrong_slots);

 private:
  std::vector<double> remembered_mm(std::span<const double> percepts_mm);
  bool differ(std::span<const double> remembered_mm) const;

  ResponderParameters parameters_;  ///< with the criterion of this trial
  Task task_;
  std::any offer_;
  std::optional<double> lifted_g_;
  RandomStream stream_;
};

/// The answer of a model that does not look, for a trial of any task.
Answer blind_answer(const TrialView& trial, const WithoutPercepts& unseen, RandomStream& stream);

/// A random answer, all equally likely; of a range of numbers a whole one. None for questions that
/// are answered to the experimenter.
/// @param seed the responder's
/// @param key in the log: every question has separate draws
std::optional<std::string> any_answer_to(const FormQuestion& question, std::uint64_t seed,
                                         const std::string& key);

}  // namespace heft
