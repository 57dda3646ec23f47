// The answers of a log's people by what each trial showed, and how likely they are of a simulated
// person who answers the same trials many times. With these, models are fitted to single trials
// (ResponderFit.h).
#pragma once

#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/configuration/ResolvedConfig.h"
#include "record/reader/LogReader.h"

namespace heft {

/// What a trial of a sorting or comparison block showed, whatever the order of its cubes.
struct Stimulus {
  std::string block, condition;
  std::optional<double> reference_g, level_g;  ///< of comparisons

  auto operator<=>(const Stimulus&) const = default;
};

struct LoggedAnswer {
  std::string outcome;
  std::optional<bool> is_correct;  ///< of a choice between different cubes

  auto operator<=>(const LoggedAnswer&) const = default;
};

/// Numbers of each answer to each stimulus.
using AnswerCounts = std::map<Stimulus, std::map<LoggedAnswer, int>>;

/// @return false: not a completed trial of a sorting or comparison block, or practice
bool add_answer(const TrialRow& trial, AnswerCounts& counts);

struct LoggedPeople {
  std::shared_ptr<const Protocol> protocol;
  std::vector<AnswerCounts> people;  ///< sessions of one participant are one person
  int n_trials = 0;                  ///< of these
};

/// @param db for messages
/// @throws Error if sessions have different protocols, or no trial can be used
LoggedPeople logged_people(const LogReader& reader, const std::string& db);

/// The protocol with blocks of these stimuli only, each presented `repeats` times: comparisons as
/// constant stimuli.
Protocol repeated_stimuli(const LoggedPeople& logged, int repeats);

/// The answers of one simulated person. @param config as for run_alone()
AnswerCounts answers_of_one(const ResolvedConfig& config, Responder& responder, std::uint64_t seed);

/// Log probability of the answers to stimuli that a simulated person answered, too: the shares of
/// their answers, each counted half a time more so that none is impossible (Jeffreys' prior).
double log_likelihood(const AnswerCounts& logged, const AnswerCounts& simulated);

}  // namespace heft
