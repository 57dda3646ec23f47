// Makes Gauss-Seidel sweeps converge faster, by Anderson's (1965) mixing with one step of memory.
// Sweeps that settle slowly do so in one direction, each change a fixed share of the last one:
// between sweeps, velocities and impulses go on to where this ends. Velocities depend linearly on
// impulses, so that both go on by the same share and still belong together. Sweeps alone decide
// when it is over: what the last one leaves is the result.
#pragma once

#include <span>
#include <vector>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

class SweepCourse {
 public:
  /// For up to so many bodies nothing is allocated later.
  void reserve(std::size_t n_bodies) { of_bodies_.reserve(n_bodies); }

  /// Before the first sweep.
  void begin(std::span<const Body> bodies, std::span<Manifold* const> manifolds);

  /// Between two sweeps.
  void go_on(std::span<Body> bodies, std::span<Manifold* const> manifolds);

 private:
  struct OfBody {
    Velocity start, change, end;  ///< of the last sweep
  };
  double share_ahead(std::span<const Body> bodies);

  std::vector<OfBody> of_bodies_;
  double last_energy_j_ = 0;  ///< of the last sweep's changes
};

}  // namespace heft::boxes
