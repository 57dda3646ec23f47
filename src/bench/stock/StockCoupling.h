// How people tie a body to a target with what Bullet offers: forces before the step, or constraint
// rows in it. Each is one way; none gives the contact solver the spring as part of the clone's
// mass, which is what physics/CouplingLaw.h does. Where each fails: see the function that makes it.
#pragma once

#include <functional>
#include <memory>

#include "bench/stock/StockWorld.h"
#include "physics/CouplingLaw.h"

namespace heft {

/// One step of the target.
struct TargetStep {
  Pose from, to;
  double h_s = 0;
};

class StockCoupling {
 public:
  virtual ~StockCoupling() = default;
  /// Steps the world while the target moves.
  virtual void step(StockWorld& world, const TargetStep& target) = 0;
};

/// Makes a coupling for a world whose clone is not kinematic. The world outlives it.
using MakeStockCoupling = std::unique_ptr<StockCoupling> (*)(StockWorld&, const Coupling&);

/// F = -k d - c v once a step, as the paper writes it. Stable for steps below 2 (sqrt 2 - 1) / w.
std::unique_ptr<StockCoupling> explicit_force(StockWorld& world, const Coupling& coupling);

/// The same, set once and held while Bullet takes substeps of at most 1/240 s: the spring still
/// sees one step, so substeps do not help it.
std::unique_ptr<StockCoupling> held_force(StockWorld& world, const Coupling& coupling);

/// The force at the end of the step, position and velocity predicted with the clone's mass (stable
/// PD control, after Tan, Liu and Turk 2011, with the position implicit too). Contacts push a clone
/// of mass m where the law needs m (1 + w h)^2: the steady lag is that many times too long.
std::unique_ptr<StockCoupling> stable_pd(StockWorld& world, const Coupling& coupling);

/// The velocity that the free oscillator has at the end of the step. In contact the steady lag is
/// e^(w h) times too long; and a spring that comes to rest within a step, such as the paper's
/// torsional one, does not undo an offset, as at its end it no longer moves.
std::unique_ptr<StockCoupling> exact_velocity(StockWorld& world, const Coupling& coupling);

/// Constraint rows softened by error reduction h k / (h k + c) and force mixing 1 / (h (h k + c)).
/// Bullet's iteration lacks the mixing in its step size: it diverges for w h < sqrt 2 - 1.
std::unique_ptr<StockCoupling> soft_rows(StockWorld& world, const Coupling& coupling);

/// btGeneric6DofSpring2Constraint with its limits on, as by default: it quietly lowers stiffness
/// and damping to what an explicit step bears.
std::unique_ptr<StockCoupling> six_dof_spring(StockWorld& world, const Coupling& coupling);

}  // namespace heft
