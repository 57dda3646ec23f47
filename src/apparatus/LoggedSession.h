// A session read back from its log with its configuration. No other file or device is opened.
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
  SessionConfig setup;              ///< the last one
  /// The session's protocol text with its settings, and the simulator of `setup`.
  std::shared_ptr<const Protocol> protocol;

  /// The protocol with the configuration in effect in a trial.
  std::shared_ptr<const Protocol> protocol_of(const TrialRow& trial) const;
  const SessionConfig& setup_of(const TrialRow& trial) const;
};

/// @throws Error if the session is missing, or its protocol or configurations cannot be read
LoggedSession load_session(const LogReader& reader, const std::string& db, std::int64_t session_id);

}  // namespace heft
