// What a participant has made up their mind to say of a trial.
#pragma once

#include <optional>
#include <vector>

#include "experiment/Task.h"

namespace heft {

struct Answer {
  std::optional<int> slot;             ///< comparison: the heavier cube, none: no difference;
                                       ///< introduction: the heaviest cube; from 1
  std::vector<Label> labels;           ///< sorting: by slot; empty: I don't know
  bool first_label_corrected = false;  ///< sorting: the first label is put wrong and moved
};

}  // namespace heft
