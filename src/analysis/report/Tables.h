// The tables of a Summary: of estimates, of records (participants, sessions, staircases,
// configurations), and all as text for a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "analysis/display/Table.h"

namespace heft {

/// The tables of these places, of records and of estimates, with rows or without.
std::vector<Table> tables_at(const Summary& summary, const std::vector<TablePlace>& places);

/// Estimates over participants, then those of each participant.
Estimates all_estimates(const Summary& summary);

/// The tables that have rows.
std::vector<Table> filled(std::vector<Table> tables);

/// Title, notes, tables and hypotheses.
std::string readable(const Summary& summary);

/// "heft 0.1.0: 13 sessions of 13 participants in heft.db (simulated)"
std::string headline(const Summary& summary);

struct RecordTable {
  TablePlace place;
  Table (*make)(const Summary& summary);
};

/// In reading order.
std::vector<RecordTable> record_tables();

/// Every trial of a session's staircases.
Table track_table(const SessionTracks& session);

}  // namespace heft
