// The staircases that people ran, choice by choice, with the procedures as they were before the
// first trial: what a model has to run again to say what it predicts.
#pragma once

#include <map>
#include <string>

#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Jnd.h"
#include "inference/PredictiveCheck.h"

namespace heft {

class StaircaseRuns {
 public:
  void add(const SessionData& data);

  /// One for each participant; empty where a staircase's procedure is not known.
  std::vector<PersonRuns> at(const Compared& compared) const;

 private:
  std::map<Compared, std::map<std::string, PersonRuns>> people_;
  std::set<Compared> unknown_;
};

}  // namespace heft
