// The demonstration video, made from the protocol: a model's hand pushes cubes of equal masses with
// a clone that stays on the effector (paper, 5.1: equal masses, no decoupling).
#pragma once

#include <memory>

#include "responders/Responder.h"
#include "session/TrialWorld.h"
#include "view/ArView.h"

namespace heft {

class Demonstration {
 public:
  Demonstration(const Protocol& protocol, std::uint64_t seed);

  /// The picture at a time since its start; times increase.
  ViewPicture at(double t_s);

 private:
  double step_s_;
  std::unique_ptr<Responder> hand_;
  TrialWorld world_;
  int count_ = 0;
  ViewPicture last_;
};

}  // namespace heft
