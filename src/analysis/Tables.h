// The tables of a Summary, and all of it as text for a terminal.
#pragma once

#include <string>
#include <vector>

#include "analysis/Summary.h"
#include "analysis/Table.h"

namespace heft {

/// Every table that has rows, in reading order.
std::vector<Table> tables_of(const Summary& summary);

/// Lists row for row that are too long for reading: sessions, staircases, choices by level.
std::vector<Table> lists_of(const Summary& summary);

/// Title, notes, tables and hypotheses.
std::string readable(const Summary& summary);

/// "heft 0.1.0: 13 sessions of 13 participants in heft.db (simulated)"
std::string headline(const Summary& summary);

}  // namespace heft
