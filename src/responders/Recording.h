// A recorded participant as a folder: trial_<trial_number>.csv, the effector's trajectory
// (experiment/Trajectory.h), and actions.csv: trial_number,t_s,action,slot,label,value (value may
// be missing). Times are seconds since the trial's start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/Error.h"
#include "experiment/EventPayloads.h"
#include "experiment/Trajectory.h"

namespace heft {

struct RecordedAction {
  TimedAction action;
  SourcePlace place;
};

/// Actions by trial number, in the file's order; times increase within a trial.
using RecordedActions = std::map<int, std::vector<RecordedAction>>;

/// @throws InvalidFile naming every invalid cell and what was expected
RecordedActions parse_actions(const std::string& text, const std::string& file);

struct Recording {
  std::string folder;
  std::map<int, Trajectory> trajectories;  ///< by trial number
  RecordedActions actions;
};

/// @throws Error if the folder or its actions.csv cannot be read; InvalidFile with the mistakes of
///   all its files
Recording load_recording(const std::string& folder);

}  // namespace heft
