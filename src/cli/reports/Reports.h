// Texts and JSON of several commands: summaries of sessions, a responder's answers to a log, checks
// of the participant's texts.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "apparatus/StudyPlaces.h"
#include "base/Error.h"
#include "experiment/ScreenTexts.h"
#include "population/Power.h"
#include "population/Tuning.h"
#include "record/reader/LogReader.h"
#include "replay/OfflineResponder.h"
#include "replay/WhatIf.h"

namespace heft {
struct Protocol;
}

namespace heft::cli {

// Sessions, for heft list and heft show. Blind: no mass, level or correctness.

struct SessionFacts {
  SessionRow row;
  int n_completed = 0, n_void = 0;       ///< attempts
  std::optional<double> planned_trials;  ///< approximately; none: the protocol cannot be read
  double duration_s = 0;                 ///< session time
  PictureCounts pictures;
  std::optional<LoggedPlace> place;  ///< in a study
  std::string head;                  ///< of the log, when the session was last sealed
};

SessionFacts facts_of(const LogReader& reader, const SessionRow& row);

/// "31 of about 70", "68"
std::string trials_text(const SessionFacts& facts);

nlohmann::ordered_json as_json(const SessionFacts& facts);

/// Warns of a log that heft analyse refuses. @param fault none: nothing is wrong
void warn_of_fault(const std::optional<std::string>& fault, const std::string& db);

/// Possible next steps with a log of these sessions: one line each, with commands to copy.
std::vector<std::string> next_steps(const std::vector<SessionFacts>& sessions,
                                    const std::string& db);

// Logs that are replayed, for heft replay.

/// Verifies sessions and prints what was found. `same` becomes false where one contradicts its
/// events, and is valid when this throws, too.
void print_verification(const LogReader& reader, const std::vector<std::int64_t>& ids, bool& same);

// Models that judge a log, for heft replay.

struct JudgedLog {
  std::vector<std::string> names;  ///< of the models, as given
  int repeats = 0;
  std::uint64_t seed = 0;
  int n_sessions = 0;
  Judgments judgments;
  double took_s = 0;  ///< wall time of the judging
};

/// Scores of all models and tasks. @param tables also sensitivity, criterion and counts of each
/// pair of answers, by reference and level
void print_judged(const JudgedLog& log, bool tables);

/// The same figures, and each trial's probabilities. Missing values are null.
std::string as_json(const JudgedLog& log);

/// Writes a chart of each model's log score by task, technique and reference.
/// @param file ends in .svg
/// @throws Error if it cannot be written, or gnuplot is missing
void draw_judged(const JudgedLog& log, const std::string& file);

/// @param tables every mass and all cues; else the lightest and the heaviest cube with three cues
void print_paths(const std::vector<PathDifference>& differences, bool tables);

/// Outcomes and JNDs, logged and of the responder.
void print_rerun(const OtherResponder& other);

// What a study can be expected to find, for heft power.

struct ModelPower {
  std::string protocol, model;
  std::uint64_t seed = 0;
  std::string level;  ///< surrogate or hand
  Power power;
  std::optional<PowerAtSize> whole;  ///< one size of the same studies by level hand
};

/// Prints hypotheses, the main figures at three sizes, and sentences on them.
/// @param tables every size and figure
void print_power(const ModelPower& found, bool tables);

std::string as_json(const std::vector<ModelPower>& all);

/// Writes a chart of power and precision against participants. @throws Error as draw_svg()
void draw_power(const ModelPower& found, const std::string& file);

/// Writes a chart of thresholds against mass. @param best null: none
/// @throws Error as draw_svg()
void draw_tuning(const std::vector<TunedTechnique>& all, const TunedTechnique* best,
                 std::uint64_t seed, const std::string& file);

/// Writes a chart by gnuplot. @param file ends in .svg
/// @param script_of the script that writes a file of that name
/// @throws Error if it cannot be written, or gnuplot is missing
void draw_svg(const std::string& file,
              const std::function<std::string(const std::string& svg)>& script_of);

// Checks of the participant's texts, for heft validate.

struct WordFaults {
  std::vector<std::string> cautions;  ///< texts that are hard to read on the smallest screen
  /// Characters that no installed font has, and questions of trials that are missing.
  std::vector<Mistake> mistakes;
};

/// Faults of a text file alone, at normal and at large text size.
WordFaults faults_in_words(const ScreenTexts& texts, const std::string& file);

/// Of all texts in a participant's session: the protocol's texts and questionnaires at the
/// protocol's text size. Each caution begins with its file. The program's own texts are assumed to
/// be valid, unless questionnaires or larger letters are used.
/// @throws Error as add_questionnaires(); InvalidFile if a file has mistakes
WordFaults faults_in_words(const Protocol& protocol, const std::string& protocol_file,
                           const std::string& language);

}  // namespace heft::cli
