// What is known about a session as it starts: its row of the `session` table and what the
// participant told.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "experiment/Rows.h"

namespace heft {

/// Why a session is run; analysis never mixes them unasked.
enum class Purpose { main, pilot, test, simulated };
template <>
struct EnumNames<Purpose> {
  static constexpr std::array<std::string_view, 4> names{"main", "pilot", "test", "simulated"};
};

/// The `session` table's row as a session starts.
struct SessionHeader {
  std::string participant;
  std::string protocol_name, protocol_text, protocol_sha256;
  std::uint64_t seed = 0;  ///< 0...2^63-1
  std::string heft_version, build;
  std::string run_options;
  std::string started_utc;
  Purpose purpose = Purpose::main;
  std::string responder;
  int log_version = todays_log_version;
  std::map<std::string, std::string> participant_info;  ///< age, handedness...; all optional
};
template <typename Row, typename Visit>
requires RowOf<Row, SessionHeader>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"participant", "", "who took part"}, row.participant);
  visit(LogColumn{"protocol_name", "", "name of the protocol's file"}, row.protocol_name);
  visit(LogColumn{"protocol_text", "", "the protocol as it was read"}, row.protocol_text);
  visit(LogColumn{"protocol_sha256", "", "hash of that text"}, row.protocol_sha256);
  visit(LogColumn{"seed", "", "that every draw of the session comes from", ">= 0"}, row.seed);
  visit(LogColumn{"heft_version", "", "version of the program that started it"}, row.heft_version);
  visit(LogColumn{"build", "", "compiler and machine that built that program"}, row.build);
  visit(LogColumn{"run_options", "", "the setup it was started with, as JSON"}, row.run_options);
  visit(LogColumn{"started_utc", "", "when it started, ISO 8601"}, row.started_utc);
  visit(LogColumn{"purpose", "", "why it was run"}, row.purpose);
  visit(LogColumn{"responder", "", "who answered when it started; see setup"}, row.responder);
  visit(LogColumn{"log_version", "", "version of the log that it was started in", ">= 1"},
        row.log_version);
}

}  // namespace heft
