// A session of a log with what it was run with, read back from the log alone.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apparatus/RunOptions.h"
#include "record/LogReader.h"

namespace heft {

/// A logged session with what it is run with, from the log alone.
struct LoggedSession {
  std::string db;
  SessionRow row;
  RunOptions options;
  std::shared_ptr<const Protocol> protocol;
  std::vector<OptionChange> changes;  ///< given again, to be logged when the session goes on
};

/// @throws Error when there is no such session, or its protocol or options can't be read
LoggedSession load_session(const LogReader& reader, const std::string& db, std::int64_t session_id);

}  // namespace heft
