// A session of a log with what it was run with, read back from the log alone: none of its files and
// devices is opened.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apparatus/configuration/ResolvedConfig.h"
#include "record/reader/LogReader.h"

namespace heft {

struct LoggedSession {
  std::string db;
  SessionRow row;
  std::vector<LoggedSetup> setups;  ///< at least one
  SessionConfig setup;              ///< in force at its end
  /// As the session's file and settings have it, with the simulator of `setup`.
  std::shared_ptr<const Protocol> protocol;

  /// The protocol with what was in force in a trial.
  std::shared_ptr<const Protocol> protocol_of(const TrialRow& trial) const;
  const SessionConfig& setup_of(const TrialRow& trial) const;
};

/// @throws Error when there is no such session, or its protocol or setups can't be read
LoggedSession load_session(const LogReader& reader, const std::string& db, std::int64_t session_id);

}  // namespace heft
