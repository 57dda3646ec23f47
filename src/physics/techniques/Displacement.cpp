#include "physics/techniques/Displacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Pose.h"
#include "base/math/Geometry.h"
#include "physics/DecouplingSimulator.h"

namespace heft {

double MassCurve::at(double mass_kg) const {
  const auto above = std::ranges::upper_bound(points_, mass_kg, {}, &Point::mass_kg);
  if (above == points_.begin()) return above->value;
  const Point& below = *std::prev(above);
  if (above == points_.end()) return below.value;
  const double fraction =
      std::log(mass_kg / below.mass_kg) / std::log(above->mass_kg / below.mass_kg);
  return std::lerp(below.value, above->value, fraction);
}

std::string displacement_text(std::string_view name, const MassCurve& curve, std::string_view unit,
                              double return_s) {
  std::string values;
  for (const MassCurve::Point& point : curve.points())
    values += fmt::format("{:g}{} at {:g} g, ", point.value, unit, 1e3 * point.mass_kg);
  return fmt::format("{} {}back in {:g} s", name, values, return_s);
}

namespace {
using Eigen::Vector3d;

constexpr double touching_m = 1e-5;
constexpr double max_travel_m = 5e-3;       // of the effector's tip in one substep
constexpr double sample_distance_m = 0.01;  // between hand and clone, less than a cube
constexpr int max_divisions = 4;            // of one substep
constexpr int n_bisections = 20;            // for the time of a contact

class DisplacedSimulator : public DecouplingSimulator {
 public:
  explicit DisplacedSimulator(std::unique_ptr<DecouplingSimulator> simulator)
      : simulator_(std::move(simulator)) {}

  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override;
  void set_clone_solid(bool solid) override;
  void place_cube(int cube, const Pose& pose) override;
  WorldState state() const override { return simulator_->state(); }
  std::optional<SolveCounts> counts() const override { return simulator_->counts(); }

 private:
  void clear_history();
  void update_contacts();
  bool meets(const Pose& effector, std::size_t cube) const;
  bool touches(std::size_t cube, const Pose& hand, const Vector3d& displacement_m) const;
  double touched_kg(const Pose& hand, const Vector3d& displacement_m) const;
  Vector3d displacement_at(const Pose& hand, double h_s) const;
  double fraction_until_change(const Pose& hand, double h_s) const;
  void step_simulator(const Pose& hand, double h_s);
  void substep(const Pose& hand, double h_s);

  std::unique_ptr<DecouplingSimulator> simulator_;
  Scene scene_;
  std::vector<BodyState> cubes_;
  bool solid_ = true;
  Pose hand_;
  Vector3d displacement_m_ = Vector3d::Zero();
  std::vector<bool> touched_;
  double touched_kg_ = 0;                      // their total mass
  Vector3d released_at_m_ = Vector3d::Zero();  // displacement at the end of the last contact
  double since_release_s_ = 0;
};

Pose moved(const Pose& hand, const Vector3d& displacement_m) {
  return {hand.position_m + displacement_m, hand.orientation};
}

void DisplacedSimulator::reset(const Scene& scene, const Pose& target) {
  simulator_->reset(scene, target);
  scene_ = scene;
  hand_ = target;
  solid_ = true;
  clear_history();
}

void DisplacedSimulator::clear_history() {
  displacement_m_ = released_at_m_ = Vector3d::Zero();
  touched_.assign(scene_.cubes.size(), false);
  touched_kg_ = 0;
  update_contacts();
}

void DisplacedSimulator::update_contacts() {
  cubes_ = simulator_->state().cubes;
  const bool held = touched_kg_ > 0;
  touched_kg_ = touched_kg(hand_, displacement_m_);
  for (std::size_t i = 0; i < cubes_.size(); ++i) touched_[i] = touches(i, hand_, displacement_m_);
  if (!held || touched_kg_ > 0) return;
  released_at_m_ = displacement_m_;
  since_release_s_ = 0;
}

bool DisplacedSimulator::meets(const Pose& effector, std::size_t cube) const {
  const Vector3d size_m = scene_.effector_size_m + Vector3d::Constant(2 * touching_m);
  return boxes_overlap(effector, size_m, cubes_[cube].pose, scene_.cubes[cube].size_m);
}

bool DisplacedSimulator::touches(std::size_t cube, const Pose& hand,
                                 const Vector3d& displacement_m) const {
  if (!solid_) return false;
  if (meets(moved(hand, displacement_m), cube)) return true;
  if (!touched_[cube]) return false;
  const double n = std::max(1.0, std::ceil(displacement_m.norm() / sample_distance_m));
  for (double i = 0; i < n; ++i)
    if (meets(moved(hand, i / n * displacement_m), cube)) return true;
  return false;
}

double DisplacedSimulator::touched_kg(const Pose& hand, const Vector3d& displacement_m) const {
  double mass_kg = 0;
  for (std::size_t i = 0; i < cubes_.size(); ++i)
    if (touches(i, hand, displacement_m)) mass_kg += scene_.cubes[i].mass_kg;
  return mass_kg;
}

Vector3d DisplacedSimulator::displacement_at(const Pose& hand, double h_s) const {
  const auto apply_law = [&](const auto& law) -> Vector3d {
    if (touched_kg_ > 0)
      return law.after(displacement_m_, hand.position_m - hand_.position_m, touched_kg_, h_s);
    const double t = (since_release_s_ + h_s) / law.return_s;
    return released_at_m_ * ((1 + t) * std::exp(-t));
  };
  return std::visit(apply_law, *scene_.displacement);
}

// The fraction of a step at which the touched cubes change or the clone reaches the hand.
double DisplacedSimulator::fraction_until_change(const Pose& hand, double h_s) const {
  const auto changed = [&](double fraction) {
    const Pose there = interpolate(hand_, hand, fraction);
    const Vector3d displacement_m = displacement_at(there, fraction * h_s);
    return touched_kg(there, displacement_m) != touched_kg_ ||
           (displacement_m.isZero(0) && !displacement_m_.isZero(0));
  };
  if (!changed(1)) return 1;
  double before = 0, after = 1;
  for (int i = 0; i < n_bisections; ++i) {
    const double middle = (before + after) / 2;
    (changed(middle) ? after : before) = middle;
  }
  return after;
}

void DisplacedSimulator::step_simulator(const Pose& hand, double h_s) {
  displacement_m_ = displacement_at(hand, h_s);
  since_release_s_ += h_s;
  hand_ = hand;
  simulator_->step(moved(hand, displacement_m_), h_s);
  update_contacts();
}

void DisplacedSimulator::substep(const Pose& hand, double h_s) {
  double left_s = h_s;
  for (int i = 0; i < max_divisions; ++i) {
    const double fraction = fraction_until_change(hand, left_s);
    if (fraction >= 1) break;
    step_simulator(interpolate(hand_, hand, fraction), fraction * left_s);
    left_s -= fraction * left_s;
  }
  step_simulator(hand, left_s);
}

void DisplacedSimulator::step(const Pose& target, double h_s) {
  const Pose from = hand_;
  const Velocity mean = mean_velocity(from, target, 1);
  const double travel_m =
      mean.linear_m_s.norm() + mean.angular_rad_s.norm() * scene_.effector_size_m.norm() / 2;
  const double n = std::max(1.0, std::ceil(travel_m / max_travel_m));
  for (double i = 1; i < n; ++i) substep(interpolate(from, target, i / n), h_s / n);
  substep(target, h_s / n);
}

void DisplacedSimulator::teleport_clone(const Pose& target, const Velocity& velocity) {
  simulator_->teleport_clone(target, velocity);
  hand_ = target;
  clear_history();
}

void DisplacedSimulator::set_clone_solid(bool solid) {
  simulator_->set_clone_solid(solid);
  solid_ = solid;
  update_contacts();
}

void DisplacedSimulator::place_cube(int cube, const Pose& pose) {
  simulator_->place_cube(cube, pose);
  touched_[static_cast<std::size_t>(cube)] = false;
  update_contacts();
}
}  // namespace

std::unique_ptr<DecouplingSimulator> displaced(std::unique_ptr<DecouplingSimulator> simulator,
                                               const Scene& scene) {
  if (!scene.displacement) return simulator;
  return std::make_unique<DisplacedSimulator>(std::move(simulator));
}

}  // namespace heft
