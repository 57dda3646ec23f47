// Projected rows as named columns of text, so that logged and folded rows can be compared and a
// difference named. Doubles are written so that equal text means equal bits.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"

namespace heft {

struct RowText {
  std::string table;  ///< as the log calls it
  std::string key;    ///< which row, for people: "cube 2 of trial 7"
  int attempt_index = 0;
  double t_s = 0;  ///< session time that the row belongs to; negative: its attempt's end
  std::vector<std::pair<std::string, std::string>> columns;
};

RowText text_of(const TrialRow& row);
RowText text_of(const CubeRow& row);
RowText text_of(const AnswerRow& row,
                int number);  ///< number: of the answer in the session, from 1
RowText text_of(const ReversalRow& row);
RowText text_of(const EstimateRow& row);

/// An event in a line.
std::string text_of(const Event& event);

}  // namespace heft
