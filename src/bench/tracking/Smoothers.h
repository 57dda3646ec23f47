// Filters for the chart of jitter against lag: ours and those that people usually try.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

class Smoother {
 public:
  virtual ~Smoother() = default;
  virtual Pose update(double t_s, const Pose& measured, double quality) = 0;
  /// meters and radians a second; zero where a filter does not know
  virtual Velocity velocity() const { return {}; }
};

struct SmootherEntry {
  std::string family;   ///< "One-Euro"
  std::string setting;  ///< "1 Hz beta 5"
  std::unique_ptr<Smoother> (*make)();

  std::string name() const { return setting.empty() ? family : family + ", " + setting; }
};

/// None first, ours second. One-Euro: Casiez, Roussel and Vogel, CHI 2012, derivative cutoff 1 Hz.
/// Kalman: position and velocity, white acceleration of a fixed size, whatever the hand does.
const std::vector<SmootherEntry>& smoothers();

}  // namespace heft
