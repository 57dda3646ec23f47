// Summary of a logged session for heft list and heft show. Blind: no mass, level or correctness.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/StudyPlaces.h"
#include "record/reader/LogReader.h"

namespace heft::cli {

struct SessionFacts {
  SessionRow row;
  int n_completed = 0, n_void = 0;       ///< attempts
  std::optional<double> planned_trials;  ///< approximately; none: the protocol cannot be read
  double duration_s = 0;                 ///< session time
  std::optional<LoggedPlace> place;      ///< in a study
};

SessionFacts facts_of(const LogReader& reader, const SessionRow& row);

/// "31 of about 70", "68"
std::string trials_text(const SessionFacts& facts);

nlohmann::ordered_json as_json(const SessionFacts& facts);

/// Possible next steps with a log of these sessions: one line each, with commands to copy.
std::vector<std::string> next_steps(const std::vector<SessionFacts>& sessions,
                                    const std::string& db);

}  // namespace heft::cli
