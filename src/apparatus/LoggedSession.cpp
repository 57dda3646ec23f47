#include "apparatus/LoggedSession.h"

namespace heft {

LoggedSession load_session(const LogReader& reader, const std::string& db,
                           std::int64_t session_id) {
  LoggedSession session;
  session.db = db;
  session.row = reader.session(session_id);
  const SessionHeader& header = session.row.header;
  session.options = run_options_from_json(header.run_options);
  Protocol protocol = parse_protocol(header.protocol_text, header.protocol_name);
  protocol.name = header.protocol_name;
  session.protocol = protocol_for(std::move(protocol), session.options);
  return session;
}

}  // namespace heft
