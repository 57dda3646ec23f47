// Typed rows from cells, column for column in the order of Schema.h. Private to this room.
#pragma once

#include <string>
#include <utility>

#include "record/Cells.h"
#include "record/LogReader.h"

namespace heft {

SessionRow session_from(Cells& cells);
std::pair<std::string, std::string> info_from(Cells& cells);
LoggedEvent event_from(Cells& cells);
TrialRow trial_from(Cells& cells);  ///< without masses
CubeRow cube_from(Cells& cells);
AnswerRow answer_from(Cells& cells);
ReversalRow reversal_from(Cells& cells);
EstimateRow estimate_from(Cells& cells);
FrameRow frame_from(Cells& cells);

}  // namespace heft
