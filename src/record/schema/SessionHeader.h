// The data of a session that are known at its start: its row in the `session` table and the answers
// about the participant.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "experiment/Rows.h"

namespace heft {

/// Purpose of a session. Analyses do not mix purposes by default.
enum class Purpose { main, pilot, test, simulated };
template <>
struct EnumNames<Purpose> {
  static constexpr std::array<std::string_view, 4> names{"main", "pilot", "test", "simulated"};
};

struct SessionHeader {
  std::string participant;
  std::string protocol_name, protocol_text, protocol_sha256;
  std::uint64_t seed = 0;  ///< 0...2^63-1
  std::string heft_version, build;
  std::string run_options;
  std::string started_utc;
  Purpose purpose = Purpose::main;
  std::string responder;
  int log_version = current_log_version;
  std::map<std::string, std::string> participant_info;  ///< age, handedness...; all optional
};
template <typename Row, typename Visit>
requires RowOf<Row, SessionHeader>
void visit_columns(Row& row, Visit&& visit) {
  visit(LogColumn{"participant", "", "participant's id"}, row.participant);
  visit(LogColumn{"protocol_name", "", "file name of the protocol"}, row.protocol_name);
  visit(LogColumn{"protocol_text", "", "contents of the protocol"}, row.protocol_text);
  visit(LogColumn{"protocol_sha256", "", "SHA-256 of protocol_text"}, row.protocol_sha256);
  visit(LogColumn{"seed", "", "seed of all random draws of the session", ">= 0"}, row.seed);
  visit(LogColumn{"heft_version", "", "version of the program that started the session"},
        row.heft_version);
  visit(LogColumn{"build", "", "compiler and machine of that program's build"}, row.build);
  visit(LogColumn{"run_options", "", "initial configuration, as JSON"}, row.run_options);
  visit(LogColumn{"started_utc", "", "start time in UTC, ISO 8601; 1970 if by heft simulate"},
        row.started_utc);
  visit(LogColumn{"purpose", "", "purpose of the session"}, row.purpose);
  visit(LogColumn{"responder", "", "initial responder; see setup"}, row.responder);
  visit(LogColumn{"log_version", "", "version of the log in which the session was started", ">= 1"},
        row.log_version);
}

}  // namespace heft
