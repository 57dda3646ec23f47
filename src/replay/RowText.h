// Projected rows as named columns of text, so that logged and folded rows can be compared and a
// difference named. Doubles are written so that equal text means equal bits.
#pragma once

#include <string>
#include <vector>

#include "experiment/Rows.h"

namespace heft {

struct ColumnText {
  std::string name, value;
  int since = 1;  ///< the version of the log that first has it
};

struct RowText {
  std::string table;  ///< as the log calls it
  std::string key;    ///< which row, for people: "cube 2 of trial 7"
  int attempt_index = 0;
  double t_s = 0;  ///< session time that the row belongs to; negative: its attempt's end
  std::vector<ColumnText> columns;
};

RowText text_of(const TrialRow& row);
RowText text_of(const CubeRow& row);
/// @param number of the answer in the session, from 1
RowText text_of(const AnswerRow& row, int number);
RowText text_of(const ReversalRow& row);
RowText text_of(const EstimateRow& row);
RowText text_of(const ParticipantParameterRow& row);
/// @param from_event the session's event that told it, from 1; 0: none
RowText text_of(const Setup& setup, int number, int from_event);

}  // namespace heft
