// The demonstration video, rendered from the protocol: a hand holds the effector as recommended and
// pushes cubes of equal masses without decoupling (paper, 5.1). It looks like a trial, filmed by a
// synthetic camera.
#pragma once

#include <memory>
#include <optional>

#include "apparatus/TrialWorld.h"
#include "responders/Responder.h"
#include "tracking/synthetic/SyntheticCamera.h"
#include "view/ArView.h"

namespace heft {

class Demonstration {
 public:
  /// @param protocol must outlive this object
  /// @param apparatus board, effector and camera; without a board no video picture is rendered
  /// @param left_hand the hand that holds the effector
  Demonstration(const Protocol& protocol, const Apparatus& apparatus, std::uint64_t seed,
                bool left_hand = false);
  Demonstration(Protocol&&, const Apparatus&, std::uint64_t, bool = false) = delete;

  /// The frame at a time since its start; times increase.
  ViewFrame at(double t_s);

 private:
  void advance();
  void film();

  double step_s_;
  Eigen::Vector3d effector_size_m_;
  std::unique_ptr<Responder> hand_;
  TrialWorld world_;
  std::optional<SyntheticCamera> camera_;
  std::uint64_t count_ = 0;  // number of frames so far
  ViewFrame last_;
};

}  // namespace heft
