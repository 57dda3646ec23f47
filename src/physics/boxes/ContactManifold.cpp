#include "physics/boxes/ContactManifold.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double flat_m = 1e-6;      // smaller gaps and overlaps are ignored
constexpr double touching_m = 2e-6;  // points nearer than this touch
// For points that were loaded in the last step. Larger values would push a cube that has been
// thrown ahead before the clone reaches it.
constexpr double still_touching_m = 0.03e-3;
constexpr double same_mass = 1e-9;           // relative difference
constexpr double no_limit_m_s = 1e100;       // of the approach speed
constexpr double max_separation_m_s = 0.05;  // at which overlaps are corrected
constexpr double steady_change = 0.3;        // largest relative change of a load within a step

bool has(unsigned set, int i) {
  return (set >> i & 1) != 0;
}

Matrix3d columns(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3d m;
  m << a, b, c;
  return m;
}

bool same_inverse_mass(double now, double then) {
  return std::abs(now - then) <= same_mass * then;
}

// Squared angle between two orientations, from the difference of the quaternions (half the angle).
double squared_angle_rad2(const Pose& now, const Pose& then) {
  return 4 * (now.orientation.coeffs() - then.orientation.coeffs()).squaredNorm();
}
}  // namespace

void ContactManifold::update(const Contact& contact, Body& first, Body& second,
                             const ContactSurface& surface, double margin_m) {
  first_ = &first;
  second_ = &second;
  on_table_ = !second.solid;
  surface_ = surface;
  margin_m_ = margin_m;
  first_updated_ = first.pose;
  second_updated_ = second.pose;
  set_points(contact);
  sticks_ = sticks_ && n_ > 0;
  first_inverse_mass_ = -1;  // outdates the responses
}

// Points that the last manifold had keep their impulses, rotated to the new frame.
void ContactManifold::set_points(const Contact& contact) {
  const std::array<int, 4> features = features_;
  const int n_before = n_;
  n_ = contact.n_points;
  if (n_ == 0) return;
  const Vector3d u = u_, v = v_;
  set_frame(contact);
  for (Points* zeroed : {&u_m_, &v_m_, &updated_gaps_m_}) zeroed->setZero();
  const std::array<Impulses, 3> old{impulses_, previous_, predicted_};
  clear_impulses();
  for (int i = 0; i < n_; ++i) {
    const ContactPoint& at = contact.points[static_cast<std::size_t>(i)];
    const Vector3d from_middle_m = at.on_first_m - first_->pose.position_m - arm_first_m_;
    features_[static_cast<std::size_t>(i)] = at.feature;
    u_m_[i] = from_middle_m.dot(u_);
    v_m_[i] = from_middle_m.dot(v_);
    updated_gaps_m_[i] = at.distance_m;
    const auto known = std::find(features.begin(), features.begin() + n_before, at.feature);
    if (known == features.begin() + n_before) continue;
    const auto j = known - features.begin();
    impulses_.row(i) = old[0].row(j);
    previous_.row(i) = old[1].row(j);
    predicted_.row(i) = old[2].row(j);
  }
  squares_m2_ = u_m_.cwiseAbs2() + v_m_.cwiseAbs2();
  spread_m_ = std::sqrt(squares_m2_.sum() / n_);
  lever_arms_ << Points::Zero(), v_m_, -u_m_;
  lever_arms_.col(0).head(n_).setOnes();
  null_vector_.setZero();
  if (n_ == 4 && surface_.is_rigid()) find_null_vector();
  if (u == u_) return;
  for (Impulses* turned : {&impulses_, &previous_, &predicted_}) {
    const Points along_u = turned->col(1), along_v = turned->col(2);
    turned->col(1) = along_u * u.dot(u_) + along_v * v.dot(u_);
    turned->col(2) = along_u * u.dot(v_) + along_v * v.dot(v_);
  }
}

// The plane of the patch contains its nearest point, because points farther away carry no load.
void ContactManifold::set_frame(const Contact& contact) {
  if (contact.normal != normal_ || u_ == v_) {
    normal_ = contact.normal;
    u_ = normal_.unitOrthogonal();
    v_ = normal_.cross(u_);
  }
  Vector3d middle_first_m = Vector3d::Zero(), middle_second_m = Vector3d::Zero();
  const ContactPoint* nearest = contact.points.data();
  for (const ContactPoint& at : contact.all()) {
    middle_first_m += at.on_first_m / n_;
    middle_second_m += at.on_second_m / n_;
    if (at.distance_m < nearest->distance_m) nearest = &at;
  }
  middle_first_m += normal_.dot(nearest->on_first_m - middle_first_m) * normal_;
  middle_second_m += normal_.dot(nearest->on_second_m - middle_second_m) * normal_;
  arm_first_m_ = middle_first_m - first_->pose.position_m;
  arm_second_m_ = middle_second_m - second_->pose.position_m;
}

double ContactManifold::begin_step(double regular_s, double ahead_s) {
  gaps_m_ = updated_gaps_m_.array() + normal_.dot(relative_displacement_m());
  if (ahead_s > 0)
    gaps_m_ -= ahead_s * (lever_arms_ *
                          relative_motion(first_->lead_velocity, second_->lead_velocity).normal);
  at_start_ = relative_motion(first_->velocity, second_->velocity);
  stuck_at_start_ = sticks_;
  last_loads_n_ = time_.h_s > 0 ? Points(impulses_.col(0) / time_.h_s) : Points(Points::Zero());
  last_h_s_ = time_.h_s;
  touching_ = 0;
  double approach_m_s = 0;
  const Points speeds = lever_arms_ * at_start_.normal;
  for (int i = 0; i < n_; ++i) {
    if (gaps_m_[i] > (impulses_(i, 0) > 0 ? still_touching_m : touching_m)) continue;
    touching_ |= 1u << i;
    const double gap_m_s = gaps_m_[i] > flat_m ? gaps_m_[i] / regular_s : 0;
    approach_m_s = std::max(approach_m_s, -speeds[i] - gap_m_s);
  }
  return surface_.is_rigid() ? approach_m_s : 0;
}

void ContactManifold::set_step(const StepTime& time) {
  if (time_.h_s > 0 && time.h_s != time_.h_s)
    for (Impulses* scaled : {&impulses_, &previous_, &predicted_}) *scaled *= time.h_s / time_.h_s;
  time_ = time;
  sticks_ = false;
  update_response();
  set_approach_limits(Limits::of_touching);
}

void ContactManifold::update_response() {
  if (!same_inverse_mass(first_->step.inverse_mass, first_inverse_mass_) ||
      !same_inverse_mass(second_->step.inverse_mass, second_inverse_mass_))
    compute_response();
}

void ContactManifold::compute_response() {
  const Motion &first = first_->step, &second = second_->step;
  first_inverse_mass_ = first.inverse_mass;
  second_inverse_mass_ = second.inverse_mass;
  Matrix3d normal_by_normal = Matrix3d::Zero();
  tangential_by_normal_.setZero();
  tangential_by_tangential_.setZero();
  normal_by_normal(0, 0) = tangential_by_tangential_(0, 0) = tangential_by_tangential_(1, 1) =
      first.inverse_mass + second.inverse_mass;
  const auto add = [&](const Motion& motion, const Vector3d& arm_m) {
    // Columns: moments about the body's center.
    const Matrix3d normal = columns(arm_m.cross(normal_), u_, v_);
    const Matrix3d tangential = columns(arm_m.cross(u_), arm_m.cross(v_), normal_);
    const Matrix3d rotation_by_normal = motion.inverse_inertia * normal;
    normal_by_normal += normal.transpose() * rotation_by_normal;
    tangential_by_normal_ += tangential.transpose() * rotation_by_normal;
    tangential_by_tangential_ += tangential.transpose() * (motion.inverse_inertia * tangential);
  };
  if (first.rotates) add(first, arm_first_m_);
  if (second.rotates) add(second, arm_second_m_);
  if (tangential_by_tangential_(2, 2) > 0) tangential_mass_ = tangential_by_tangential_.inverse();
  normal_response_.noalias() = lever_arms_ * normal_by_normal * lever_arms_.transpose();
  effective_mass_set_ = 0;
  sliding_mass_kg_.setZero();
}

// Rigid points in contact close their gaps and correct their overlaps by the end of the lookahead.
void ContactManifold::set_approach_limits(Limits limits) {
  softness_.setZero();
  const bool rigid = surface_.is_rigid();
  if (rigid && touching_ == 0b1111 && gaps_m_.cwiseAbs().maxCoeff() < flat_m) {  // the usual case
    approach_limit_m_s_.setZero();
    return;
  }
  approach_limit_m_s_.setConstant(no_limit_m_s);
  double nearest_m = gaps_m_[0];
  for (int i = 1; i < n_; ++i) nearest_m = std::min(nearest_m, gaps_m_[i]);
  for (int i = 0; i < n_; ++i) {
    const double gap_m = gaps_m_[i] < nearest_m + flat_m ? nearest_m : gaps_m_[i];
    if (!rigid && (limits == Limits::of_all || has(touching_, i))) {
      set_compliant_limit(i, gap_m);
    } else if (rigid && has(touching_, i)) {
      approach_limit_m_s_[i] = 0;
      if (gap_m > flat_m) approach_limit_m_s_[i] = gap_m / (time_.h_s + time_.lookahead_s);
      if (gap_m < -flat_m)
        approach_limit_m_s_[i] =
            -std::min(max_separation_m_s, -(gap_m + flat_m) / (time_.h_s + time_.lookahead_s));
    }
  }
}

// The contact law holds at the end of the lookahead:
//   compliance * force there = -gap there - damping time * speed,
// critically damped for the effective mass of the point. This damps stiff contacts within a step,
// at any length of the step, but leads by the time from the middle of the step: with the force over
// the step on the left, loads that change slowly would be ahead of the gaps by that time. Where the
// law at the start of the step confirms the force over the last step, the force there is
// extrapolated instead, which makes the solution second-order in the step. Elsewhere, as in a
// collision, it stays first-order: an extrapolated force would pull at points that separate.
void ContactManifold::set_compliant_limit(int i, double gap_m) {
  const double c = surface_.compliance_m_per_n;
  const double damping_s = gap_m < 0 ? 2 * std::sqrt(c / normal_response_(i, i)) : 0;
  const double over_s = time_.h_s + time_.lookahead_s + damping_s;
  const double last_m = c * last_loads_n_[i];
  const double at_start_m = gap_m + over_s * lever_arms_.row(i).dot(at_start_.normal);
  const bool steady = std::abs(at_start_m + last_m) < steady_change * last_m;
  const double ahead_s = time_.lookahead_s + time_.h_s / 2;
  const double growth = steady ? ahead_s / ((time_.h_s + last_h_s_) / 2) : 0;
  softness_[i] = c * (1 + growth) / (time_.h_s * over_s);
  approach_limit_m_s_[i] = (gap_m - growth * last_m) / over_s;
}

void ContactManifold::add_speculative_limits() {
  if (!surface_.is_rigid()) {
    set_approach_limits(Limits::of_all);
    return;
  }
  for (int i = 0; i < n_; ++i)
    if (!has(touching_, i)) approach_limit_m_s_[i] = gaps_m_[i] / (time_.h_s + time_.lookahead_s);
}

// The relative acceleration is constant, from the velocity at the start to the solved mean.
std::optional<double> ContactManifold::fraction_before_meeting() const {
  const Points at_start = lever_arms_ * at_start_.normal;
  const Points mean_m_s =
      lever_arms_ * relative_motion(first_->step.mean, second_->step.mean).normal;
  std::optional<double> first;
  for (int i = 0; i < n_; ++i) {
    const double gap_m = gaps_m_[i], start_m = time_.h_s * at_start[i];
    const double mean_m = time_.h_s * mean_m_s[i];
    if (has(touching_, i) || gap_m + mean_m > -flat_m) continue;
    // gap + start s + (mean - start) s^2 = 0
    const double quadratic_m = mean_m - start_m;
    const double root_m = std::sqrt(std::max(0.0, start_m * start_m - 4 * quadratic_m * gap_m));
    const double fraction = 2 * gap_m / (root_m - start_m);
    if (fraction > 0) first = std::min(first.value_or(1), fraction);
  }
  return first;
}

void ContactManifold::begin_impact() {
  update_response();
  sustained_ = impulses_;
  impulses_.setZero();
  softness_.setZero();
  for (int i = 0; i < n_; ++i) approach_limit_m_s_[i] = has(touching_, i) ? 0 : no_limit_m_s;
}

Vector3d ContactManifold::end_impact() {
  const Vector3d impact_n_s = world_sum(impulses_);
  impulses_ = sustained_;
  return impact_n_s;
}

void ContactManifold::clear_impulses() {
  for (Impulses* zeroed : {&impulses_, &previous_, &predicted_}) zeroed->setZero();
}

// Displacement of the first body relative to the second since update(). Moving along the table
// changes no contact.
Vector3d ContactManifold::relative_displacement_m() const {
  const Vector3d moved_m = first_->pose.position_m - first_updated_.position_m;
  if (on_table_) return {0, 0, moved_m.z()};
  return moved_m - (second_->pose.position_m - second_updated_.position_m);
}

bool ContactManifold::is_current(double margin_m) const {
  if (n_ == 0 || (n_ < 4 && margin_m > margin_m_)) return false;
  if (!on_table_ && !touches()) return false;  // another face may be nearer now
  const double same_2 = surface_.same_place() * surface_.same_place();
  return relative_displacement_m().squaredNorm() < same_2 &&
         squared_angle_rad2(first_->pose, first_updated_) < same_2 &&
         squared_angle_rad2(second_->pose, second_updated_) < same_2;
}

Vector3d ContactManifold::world_sum(const Impulses& impulses) const {
  const Vector3d sum = impulses.colwise().sum();
  return n_ == 0 ? Vector3d::Zero() : Vector3d(sum[0] * normal_ + sum[1] * u_ + sum[2] * v_);
}

}  // namespace heft::boxes
