// `quasi_static`: `push` without inertia. The clone lags by min(x_hand, mu M g / k), where x_hand
// is the distance that the effector has moved since the clone touched the cube (paper,
// section 3.2).
#include <algorithm>

#include "physics/DecouplingSimulator.h"
#include "physics/push/StraightStroke.h"

namespace heft {

namespace {
class QuasiStaticSimulator : public DecouplingSimulator {
 public:
  void reset(const Scene& scene, const Pose& target) override {
    stroke_ = StraightStroke(scene, target);
    solid_ = true;
    clone_ = stroke_.clone_start();
    v_ = cube_v_ = force_n_ = 0;
  }

  void step(const Pose& target, double h_s) override {
    const double hand = stroke_.follow(target), before = clone_;
    cube_v_ = force_n_ = 0;
    clone_ = hand;
    if (solid_ && stroke_.cube() && hand > stroke_.contact()) push(hand, h_s);
    v_ = (clone_ - before) / h_s;
    stroke_.check(clone_, force_n_ > 0);
  }

  void teleport_clone(const Pose& target, const Velocity&) override {
    stroke_.restart(target);
    clone_ = v_ = cube_v_ = force_n_ = 0;
  }
  void set_clone_solid(bool solid) override { solid_ = solid; }
  void place_cube(int cube, const Pose& pose) override {
    stroke_.place_cube(static_cast<std::size_t>(cube), pose);
  }
  WorldState state() const override { return stroke_.state(clone_, v_, cube_v_, force_n_); }

 private:
  // The spring's force is at most the friction limit; beyond that the cube follows.
  void push(double hand, double h_s) {
    const Scene& scene = stroke_.scene();
    const double slide_n = stroke_.slide_n();
    const double stiffness = scene.coupling.stiffness_n_per_m;
    const double longest_m = scene.coupling.decoupled ? slide_n / stiffness : 0;
    const double lag_m = std::min(hand - stroke_.contact(), longest_m);
    clone_ = hand - lag_m;
    cube_v_ = (clone_ - stroke_.contact()) / h_s;
    stroke_.move_cube_to(clone_);
    force_n_ = scene.coupling.decoupled ? stiffness * lag_m : slide_n;
  }

  StraightStroke stroke_;
  bool solid_ = true;
  double clone_ = 0, v_ = 0, cube_v_ = 0, force_n_ = 0;  // along the line
};
}  // namespace

std::unique_ptr<DecouplingSimulator> make_quasi_static() {
  return std::make_unique<QuasiStaticSimulator>();
}

}  // namespace heft
