#include "analysis/Flow.h"

namespace heft {

std::string in_short(const std::string& why) {
  return why.substr(0, why.find(':'));
}

void FlowFold::add(const SessionData& data) {
  Way& way = ways_[data.participant()];
  way.declined = way.declined || !data.events.consented.value_or(true);
  way.agreed = way.agreed || data.events.consented.value_or(false);
  way.started = way.started || !data.attempts.empty();
  way.finished = way.finished || data.finished();
  way.last = data.session.state;
}

ParticipantFlow FlowFold::result(std::span<const ParticipantRow> participants) const {
  ParticipantFlow flow;
  flow.n_asked = static_cast<int>(ways_.size());
  for (const auto& [participant, way] : ways_) {
    flow.n_declined += way.declined && !way.agreed && !way.started ? 1 : 0;
    flow.n_started += way.started ? 1 : 0;
    flow.n_finished += way.started && way.finished ? 1 : 0;
    if (way.started && !way.finished) flow.unfinished[std::string(name_of(way.last))] += 1;
  }
  for (const ParticipantRow& row : participants) {
    if (row.excluded()) flow.excluded[in_short(row.excluded_because)] += 1;
    flow.n_analyzed += !row.excluded() && ways_.at(row.participant).started ? 1 : 0;
  }
  return flow;
}

ParticipantFlow flow_of(std::span<const SessionData> sessions,
                        std::span<const ParticipantRow> participants) {
  FlowFold fold;
  for (const SessionData& data : sessions) fold.add(data);
  return fold.result(participants);
}

}  // namespace heft
