// The whole analysis of a log: options in, one Summary out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

struct AnalysisOptions {
  std::vector<std::string> databases;     ///< the logs' files
  std::vector<std::int64_t> session_ids;  ///< of a single log; empty: all
  bool mix = false;                       ///< put sessions of several purposes together
  std::string command;                    ///< the command line, printed below every chart
  LogIntegrity integrity = {};
  /// Check models by simulated studies, the slowest step.
  bool check_models = true;
};

/// Reads the logs and summarizes them together; participants of several logs are different.
/// @throws Error as LoggedSessions, or when they hold several purposes that were not to be mixed
Summary analyze(const AnalysisOptions& options);

/// The same for data at hand.
/// @param command as AnalysisOptions has it
Summary summarize(const Dataset& dataset, const std::string& command);

}  // namespace heft
