// `push`: clone and cube along one straight stroke, with one degree of freedom, exact between the
// effector's poses. The free clone and the clone that slides with the cube are damped oscillators
// in closed form; the motion is divided at contact, slip, stop and separation. Coulomb friction,
// rigid contacts, no restitution. Throws OutsideModel for all other movements.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/DecouplingSimulator.h"
#include "physics/push/Oscillation.h"
#include "physics/push/StraightStroke.h"

namespace heft {

namespace {
constexpr double touching_m = 1e-12;
constexpr double still_m_s = 1e-12;
constexpr double slipping = 1 - 1e-12;  // fraction of the friction limit at which sliding starts
constexpr int max_events = 1000;        // in one step

// Number of intervals in which events are searched, so that none is missed.
int n_intervals(double omega_rad_s, double h_s) {
  const double n = 2 * omega_rad_s * h_s;
  return n <= 1 ? 1 : static_cast<int>(std::min(std::ceil(n), 1000.0));
}

struct Fall {
  double t_s;
  bool fell;
};

// Root of f within (from, to], where f(to) <= 0, to 1e-12 s: false position with the Illinois rule,
// which halves the weight of an end that stays.
template <typename F>
double bracketed_root(const F& f, double from_s, double at_from, double to_s, double at_to) {
  constexpr double exactly_s = 1e-12;
  int last = 0;
  for (int i = 0; i < 100 && to_s - from_s > exactly_s && at_to < 0; ++i) {
    const double fraction = at_from > 0 && i < 20 ? at_from / (at_from - at_to) : 0.5;
    const double t_s = from_s + fraction * (to_s - from_s);
    if (!(t_s > from_s && t_s < to_s)) break;
    const double at = f(t_s);
    const int side = at > 0 ? 1 : -1;
    (at > 0 ? from_s : to_s) = t_s;
    (at > 0 ? at_from : at_to) = at;
    if (side == last) (at > 0 ? at_to : at_from) /= 2;
    last = side;
  }
  return to_s;
}

// The first time in (0, end_s] at which f is zero or below, or end_s. f(0) may be zero or rounding.
template <typename F>
Fall first_fall(const F& f, double end_s, int n) {
  double from_s = 0, at_from = 0;
  for (int i = 1; i <= n; ++i) {
    const double to_s = i == n ? end_s : end_s * i / n, at_to = f(to_s);
    if (at_to <= 0) return {bracketed_root(f, from_s, at_from, to_s, at_to), true};
    from_s = to_s;
    at_from = at_to;
  }
  return {end_s, false};
}

class PushSimulator : public DecouplingSimulator {
 public:
  void reset(const Scene& scene, const Pose& target) override;
  void step(const Pose& target, double h_s) override;
  void teleport_clone(const Pose& target, const Velocity& velocity) override;
  void set_clone_solid(bool solid) override { solid_ = solid; }
  void place_cube(int cube, const Pose& pose) override;
  WorldState state() const override;

 private:
  // Each simulates left_s seconds, or less up to the next event, and returns that time.
  double apart(double left_s);
  double sticking(double left_s);
  double sliding(double left_s);
  double carried(double left_s);
  double advance(double left_s);

  bool has_cube() const { return solid_ && stroke_.cube().has_value(); }
  bool touching() const { return has_cube() && stroke_.contact() - clone_ <= touching_m; }
  double spring_n() const { return -stiffness_ * (clone_ - target_) - damping_ * (v_ - u_); }
  double slide_n() const { return deceleration_ * cube_kg_; }
  // Whether the spring decelerates the clone more than friction alone decelerates a sliding cube.
  bool parts() const { return spring_n() + deceleration_ * mass_ < (1 - slipping) * slide_n(); }
  bool may_meet(double left_s) const;
  Oscillation::At free_clone(double t_s) const;
  double cube_at(double t_s) const;
  void collide();
  void take_cube();

  StraightStroke stroke_;
  bool decoupled_ = true, solid_ = true;
  double mass_ = 0, stiffness_ = 0, damping_ = 0, deceleration_ = 0;
  Oscillation free_, together_;
  double cube_kg_ = 0;
  double rest_ = 0;  // offset from the target of a clone that slides with the cube steadily
  Eigen::Vector3d start_velocity_ = Eigen::Vector3d::Zero();  // until the line has a direction
  bool started_ = false;
  // Along the line: the target and its speed in this step, the clone, the cube.
  double target_ = 0, u_ = 0, clone_ = 0, v_ = 0, cube_v_ = 0;
  double impulse_n_s_ = 0;            // of the clone on the cube over the last step
  double step_s_ = 0, per_step_ = 0;  // the last step's length, and one over it
};

void PushSimulator::reset(const Scene& scene, const Pose& target) {
  const Coupling& coupling = scene.coupling;
  decoupled_ = coupling.decoupled;
  mass_ = coupling.clone_mass_kg;
  stiffness_ = coupling.stiffness_n_per_m;
  damping_ = coupling.damping_ratio * 2 * std::sqrt(stiffness_ * mass_);
  free_ = Oscillation(mass_, damping_, stiffness_);
  stroke_ = StraightStroke(scene, target);
  solid_ = true;
  start_velocity_.setZero();
  started_ = stroke_.has_direction();
  target_ = u_ = v_ = cube_v_ = impulse_n_s_ = 0;
  clone_ = stroke_.clone_start();
  take_cube();
}

void PushSimulator::take_cube() {
  if (!stroke_.cube()) return;
  const Scene& scene = stroke_.scene();
  cube_kg_ = scene.cubes[*stroke_.cube()].mass_kg;
  deceleration_ = scene.table_friction(*stroke_.cube()) * scene.gravity_m_s2;
  together_ = Oscillation(mass_ + cube_kg_, damping_, stiffness_);
  rest_ = -slide_n() / stiffness_;
}

void PushSimulator::step(const Pose& target, double h_s) {
  const double to = stroke_.follow(target);
  if (!started_ && stroke_.has_direction()) {
    v_ = start_velocity_.dot(stroke_.direction());
    started_ = true;
    take_cube();
  }
  if (h_s != step_s_) per_step_ = 1 / h_s;
  step_s_ = h_s;
  u_ = (to - target_) * per_step_;
  impulse_n_s_ = 0;
  double left_s = h_s;
  for (int event = 0; left_s > 0 && event < max_events; ++event) left_s -= advance(left_s);
  if (left_s > 0) throw OutsideModel("clone and cube separate and meet too often");
  target_ = to;
  if (!decoupled_) clone_ = to;
  stroke_.check(clone_, solid_ && (impulse_n_s_ > 0 || touching()));
}

double PushSimulator::advance(double left_s) {
  if (!touching()) return apart(left_s);
  if (!decoupled_) {
    if (u_ < cube_v_ || u_ < 0) return apart(left_s);
    return carried(left_s);
  }
  if (v_ > cube_v_) collide();
  if (cube_v_ > 0) return v_ < cube_v_ || parts() ? apart(left_s) : sliding(left_s);
  if (v_ < 0) return apart(left_s);
  const double force_n = spring_n();
  if (force_n > slide_n() || (force_n >= slipping * slide_n() && u_ > 0)) return sliding(left_s);
  const bool leaves = force_n < 0 || (force_n <= (1 - slipping) * slide_n() && u_ < 0);
  return leaves ? apart(left_s) : sticking(left_s);
}

// Inelastic: both have the same velocity afterwards.
void PushSimulator::collide() {
  const double common = (mass_ * v_ + cube_kg_ * cube_v_) / (mass_ + cube_kg_);
  impulse_n_s_ += cube_kg_ * (common - cube_v_);
  v_ = cube_v_ = common;
}

// The free clone, relative to the target at that time.
Oscillation::At PushSimulator::free_clone(double t_s) const {
  return decoupled_ ? free_.after(t_s, clone_ - target_, v_ - u_) : Oscillation::At{};
}

double PushSimulator::cube_at(double t_s) const {
  const double sliding_s = deceleration_ > 0 ? std::min(t_s, cube_v_ / deceleration_) : t_s;
  return stroke_.contact() + (cube_v_ - deceleration_ * sliding_s / 2) * sliding_s;
}

// A bound without exponentials: an oscillator's offset exceeds its first one by at most its first
// speed over omega.
bool PushSimulator::may_meet(double left_s) const {
  const double offset =
      decoupled_ ? std::max(0.0, clone_ - target_) + std::abs(v_ - u_) / free_.omega_rad_s() : 0;
  return target_ + std::max(0.0, u_ * left_s) + offset >= stroke_.contact();
}

// Clone and cube move independently until they meet. A cube that meets a coupled clone takes its
// velocity.
double PushSimulator::apart(double left_s) {
  Fall meeting{left_s, false};
  if (has_cube() && may_meet(left_s)) {
    const auto gap_m = [&](double t_s) {
      return cube_at(t_s) - (target_ + u_ * t_s + free_clone(t_s).y);
    };
    meeting = first_fall(gap_m, left_s, n_intervals(free_.omega_rad_s(), left_s));
  }
  const auto [t_s, met] = meeting;
  const Oscillation::At now = free_clone(t_s);
  if (met || (stroke_.cube() && cube_v_ > 0)) stroke_.move_cube_to(cube_at(t_s));
  target_ += u_ * t_s;
  clone_ = met ? stroke_.contact() : target_ + now.y;
  v_ = now.speed + u_;
  cube_v_ = std::max(0.0, cube_v_ - deceleration_ * t_s);
  if (met && !decoupled_) {
    impulse_n_s_ += cube_kg_ * std::max(0.0, u_ - cube_v_);
    cube_v_ = std::max(u_, cube_v_);
  }
  return t_s;
}

// Clone and cube are at rest while the spring is loaded, until friction yields or the force is
// zero.
double PushSimulator::sticking(double left_s) {
  v_ = 0;
  const double force_n = spring_n(), change_n_s = stiffness_ * u_;
  double t_s = left_s;
  if (change_n_s > 0) t_s = std::min(t_s, (slide_n() - force_n) / change_n_s);
  if (change_n_s < 0) t_s = std::min(t_s, -force_n / change_n_s);
  target_ += u_ * t_s;
  impulse_n_s_ += (force_n + change_n_s * t_s / 2) * t_s;
  return t_s;
}

// One oscillator of both masses under friction, until it stops or friction alone decelerates the
// cube more than the spring decelerates the clone.
double PushSimulator::sliding(double left_s) {
  const double y = clone_ - target_ - rest_, speed = v_ - u_;
  const auto after = [&](double at_s) { return together_.after(at_s, y, speed); };
  const auto hold_together = [&](const Oscillation::At& at) {
    return std::min(at.speed + u_ + still_m_s, at.acceleration + deceleration_);
  };
  const int n = n_intervals(together_.omega_rad_s(), left_s);
  Oscillation::At now = after(left_s);
  double t_s = left_s;
  if (n > 1 || hold_together(now) <= 0) {
    t_s = first_fall([&](double at_s) { return hold_together(after(at_s)); }, left_s, n).t_s;
    now = after(t_s);
  }
  const double before = v_;
  target_ += u_ * t_s;
  clone_ = target_ + rest_ + now.y;
  v_ = std::max(0.0, now.speed + u_);
  impulse_n_s_ += cube_kg_ * (v_ - before) + slide_n() * t_s;
  cube_v_ = v_;
  stroke_.move_cube_to(clone_);
  return t_s;
}

// A coupled clone carries the cube.
double PushSimulator::carried(double left_s) {
  impulse_n_s_ += cube_kg_ * (u_ - cube_v_) + (u_ > 0 ? slide_n() * left_s : 0);
  clone_ = target_ + u_ * left_s;
  v_ = cube_v_ = u_;
  target_ = clone_;
  stroke_.move_cube_to(clone_);
  return left_s;
}

void PushSimulator::teleport_clone(const Pose& target, const Velocity& velocity) {
  if (cube_v_ > 0) throw OutsideModel("the effector jumps while a cube slides");
  stroke_.restart(target);
  start_velocity_ = velocity.linear_m_s;
  started_ = false;
  target_ = u_ = clone_ = v_ = cube_v_ = impulse_n_s_ = 0;
}

void PushSimulator::place_cube(int cube, const Pose& pose) {
  stroke_.place_cube(static_cast<std::size_t>(cube), pose);
  cube_v_ = impulse_n_s_ = 0;
  take_cube();
}

WorldState PushSimulator::state() const {
  return stroke_.state(clone_, v_, cube_v_, impulse_n_s_ > 0 ? impulse_n_s_ / step_s_ : 0);
}
}  // namespace

std::unique_ptr<DecouplingSimulator> make_push() {
  return std::make_unique<PushSimulator>();
}

}  // namespace heft
