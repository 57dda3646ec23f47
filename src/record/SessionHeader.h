// What is known about a session as it starts: its row of the `session` table and what the
// participant told.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace heft {

/// The `session` table's row as a session starts.
struct SessionHeader {
  std::string participant;
  std::string protocol_name, protocol_text, protocol_sha256;
  std::uint64_t seed = 0;  ///< 0...2^63-1
  std::string heft_version, build;
  std::string run_options;  ///< JSON: the options it was started with
  std::string purpose;      ///< main, pilot, test or simulated
  std::string responder;
  std::string started_utc;  ///< ISO 8601, the session's one anchor in UTC
  std::map<std::string, std::string> participant_info;  ///< age, handedness...; all optional
};

}  // namespace heft
