// Tables of records rather than estimates: participants, sessions, staircases, configurations.
#pragma once

#include <vector>

#include "analysis/dataset/Summary.h"
#include "analysis/report/Table.h"

namespace heft {

struct RecordTable {
  TablePlace place;
  Table (*make)(const Summary& summary);
};

/// In reading order.
std::vector<RecordTable> record_tables();

/// Every trial of a session's staircases.
Table track_table(const SessionTracks& session);

/// The estimates that the paper has a figure for, each once.
std::vector<const StudyEstimate*> published_among(const Summary& summary);

}  // namespace heft
