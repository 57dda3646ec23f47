#include "apparatus/LoggedSession.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "psychophysics/UpDown.h"
#include "tasks/Comparison.h"

namespace heft {

namespace {
// A resumed session keeps the censoring rule of its first estimates.
void keep_censoring_rule(Protocol& protocol, int log_version) {
  constexpr int first_with_cut_moves = 6;
  if (log_version >= first_with_cut_moves) return;
  for (Block& block : protocol.blocks)
    if (auto* comparison = block_as<Comparison::Block>(block))
      for (ReferenceStaircase& entry : comparison->staircases)
        if (const auto* up_down = entry.staircase.get_if<UpDown>()) {
          UpDownConfig config = up_down->config();
          config.censoring = CensoringRule::levels_at_bounds;
          entry.staircase = {entry.staircase.name(), config};
        }
}
}  // namespace

const SessionConfig& LoggedSession::setup_of(const TrialRow& trial) const {
  const auto found = std::ranges::find(setups, trial.setup_index, &LoggedSetup::setup_index);
  return found == setups.end() ? setups.front().setup : found->setup;
}

std::shared_ptr<const Protocol> LoggedSession::protocol_of(const TrialRow& trial) const {
  return protocol_for(*protocol, setup_of(trial));
}

LoggedSession load_session(const LogReader& reader, const std::string& db,
                           std::int64_t session_id) {
  LoggedSession session;
  session.db = db;
  session.row = reader.session(session_id);
  session.setups = reader.setups(session_id);
  if (session.setups.empty())
    throw Error(
        fmt::format("session {} in {} has no recorded configuration: its setup is "
                    "missing",
                    session_id, db));
  const SessionHeader& header = session.row.header;
  Protocol protocol = parse_protocol(header.protocol_text, header.protocol_name,
                                     session.setups.front().setup.settings);
  protocol.name = header.protocol_name;
  keep_censoring_rule(protocol, header.log_version);
  constexpr int first_without_gaps_in_contacts = 8;
  protocol.gaps_end_contacts = header.log_version >= first_without_gaps_in_contacts;
  session.setup = session.setups.back().setup;
  session.protocol = protocol_for(std::move(protocol), session.setup);
  return session;
}

}  // namespace heft
