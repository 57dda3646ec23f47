// The tables of a Summary one by one; Tables.h puts them together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/Summary.h"
#include "analysis/Table.h"

namespace heft {

std::vector<Table> sorting_tables(const Summary& summary);      ///< with the introduction
std::vector<Table> comparison_tables(const Summary& summary);   ///< JNDs and choices
std::vector<Table> quality_tables(const Summary& summary);      ///< what is counted first
std::vector<Table> sensitivity_tables(const Summary& summary);  ///< thresholds
std::vector<Table> session_tables(const Summary& summary);      ///< response times and voids

// Row for row, for CSV files only.
Table staircase_list(const Summary& summary);
Table level_list(const Summary& summary);
Table session_list(const Summary& summary);
Table label_table(const Summary& summary);
Table published_table(const Summary& summary);
Table participant_list(const Summary& summary);
Table flow_table(const Summary& summary);
Table tracking_table(const Summary& summary);
Table threshold_list(const Summary& summary);
Table setup_table(const Summary& summary);
Table incident_table(const Summary& summary);
Table dictionary_table(const Summary& summary);
Table track_list(const SessionTracks& session, const Summary& summary);
std::vector<Table> point_lists(const Summary& summary);  ///< what the figures show point by point

// Cells that several tables have.
Cell low(const std::optional<Interval>& interval);
Cell high(const std::optional<Interval>& interval);
Cell kind_word(MeanKind kind);
Cell mass(double mass_g);  ///< as many decimals as it has
template <typename Enum>
Cell named_cell(Enum value) {
  return word(std::string(name_of(value)));
}

/// "Sorting" becomes "Sorting (simulated)" where it is.
std::string titled(std::string_view title, const Summary& summary);

}  // namespace heft
