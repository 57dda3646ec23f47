#include "physics/boxes/BoxWorld.h"

#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double resting_m_s = 1e-4, resting_rad_s = 5e-3, resting_for_s = 0.25;
// Speculative margin of the contact detection, in addition to the bodies' motion in a step.
constexpr double contact_margin_m = 0.1e-3;
constexpr double speed_gain_m_s = 0.1;  // upper bound within a step
// Margin of the neighbor list beyond the detection margin: distance that bodies move before it is
// renewed.
constexpr double list_margin_m = 0.02;
constexpr double min_travel_m = 0.1e-3;  // smaller ones need no swept contact detection
constexpr double separated_m = 1e-6;     // gap after one box has slid off another
constexpr double flush_m = 1e-9;
// Faster approach is an impact. Contact forces stop slower approach within a step and return a
// third of it, which friction and weight remove in the same step.
constexpr double impact_m_s = 0.01, impact_m_s2 = 10;
constexpr double min_step_s = 1e-6;       // up to an event
constexpr double min_remainder_s = 5e-6;  // of a step after an event
}  // namespace

BoxWorld::BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies)
    : surface_(surface), gravity_m_s2_(gravity_m_s2) {
  const std::size_t n_pairs = n_bodies * (n_bodies + 1) / 2;
  bodies_.reserve(n_bodies);
  listed_m_.reserve(n_bodies);
  for (auto* pairs : {&pairs_, &old_pairs_}) pairs->reserve(n_pairs);
  touching_.reserve(n_pairs);
  table_.solid = false;  // marks the table
}

std::size_t BoxWorld::add(const Body& body) {
  bodies_.push_back(body);
  listed_m_.push_back(body.pose.position_m);
  listed_reach_m_ = 0;
  return bodies_.size() - 1;
}

void BoxWorld::sleep_resting_bodies() {
  for (Body& body : bodies_) {
    const Contact standing = contact_with_table(body.shape, contact_margin_m);
    body.asleep = !body.driven && standing.n_points == 4;
    for (const ContactPoint& point : standing.all())
      if (std::abs(point.distance_m) > flush_m) body.asleep = false;
  }
  for (Body& first : bodies_)
    for (Body* second = bodies_.data(); second != &first; ++second)
      if (within(first, *second, contact_margin_m) &&
          contact_between(first.shape, second->shape, contact_margin_m).n_points > 0)
        first.asleep = second->asleep = false;
  listed_reach_m_ = 0;
}

double BoxWorld::travel_bound_m(const Body& body, double h_s) const {
  if (!body.is_active()) return 0;
  const double free_m_s = body.driven ? body.point_speed_bound_m_s(body.step.mean) : 0;
  return contact_margin_m +
         h_s * (speed_gain_m_s + std::max(free_m_s, body.point_speed_bound_m_s(body.velocity)));
}

bool BoxWorld::within(const Body& first, const Body& second, double margin_m) const {
  const double reach_m = first.radius_m + second.radius_m + margin_m;
  return (first.pose.position_m - second.pose.position_m).squaredNorm() < reach_m * reach_m;
}

Contact BoxWorld::contact(const Pair& pair, double h_s, double margin_m) const {
  const Body& first = bodies_[pair.first];
  const Body& second = bodies_[pair.second];
  if (pair.with_table()) return contact_with_table(first.shape, margin_m);
  if (!within(first, second, margin_m)) return {};
  const auto velocity = [](const Body& body) {
    return body.driven ? body.step.mean.linear_m_s : body.velocity.linear_m_s;
  };
  const Vector3d travel_m = h_s * (velocity(first) - velocity(second));
  if (pair.manifold.touches() || travel_m.squaredNorm() < min_travel_m * min_travel_m)
    return contact_between(first.shape, second.shape, margin_m);
  return contact_on_the_way(first.shape, second.shape, travel_m, margin_m);
}

// The list is valid while no two bodies together can move farther than its reach.
void BoxWorld::update_neighbors(double h_s) {
  double farthest_m = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].travel_bound_m = travel_bound_m(bodies_[i], h_s);
    if (bodies_[i].asleep) continue;
    const double moved_m = (bodies_[i].pose.position_m - listed_m_[i]).norm();
    farthest_m = std::max(farthest_m, moved_m + bodies_[i].travel_bound_m);
  }
  if (2 * farthest_m <= listed_reach_m_) return;
  listed_reach_m_ = 2 * farthest_m + list_margin_m;
  list_neighbors();
}

void BoxWorld::list_neighbors() {
  std::swap(pairs_, old_pairs_);
  pairs_.clear();
  const auto list = [this](std::size_t i, std::size_t j) {
    const auto known = std::ranges::find_if(
        old_pairs_, [&](const Pair& pair) { return pair.first == i && pair.second == j; });
    if (known != old_pairs_.end())
      pairs_.push_back(*known);
    else
      pairs_.push_back({i, j, {}, Vector3d::Zero()});
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    listed_m_[i] = bodies_[i].pose.position_m;
    for (std::size_t j = 0; j < i; ++j) {
      const Body &first = bodies_[i], &second = bodies_[j];
      if (!(first.asleep && second.asleep) && within(first, second, listed_reach_m_)) list(i, j);
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].asleep) list(i, i);
}

// @return whether a body woke
bool BoxWorld::wake_within_reach(double h_s) {
  bool any = false;
  for (bool more = true; more; any = any || more) {
    more = false;
    for (const Pair& pair : pairs_) {
      Body& first = bodies_[pair.first];
      Body& second = bodies_[pair.second];
      if (first.asleep == second.asleep || !first.solid || !second.solid) continue;
      const double margin_m = first.travel_bound_m + second.travel_bound_m;
      if (!within(first, second, margin_m) || contact(pair, h_s, margin_m).n_points == 0) continue;
      for (Body* woken : {&first, &second}) {
        woken->wake();
        woken->travel_bound_m = travel_bound_m(*woken, h_s);
      }
      more = true;
    }
    if (more) list_neighbors();
  }
  return any;
}

double BoxWorld::advance(double h_s, const StepOptions& options) {
  const StepTime time = time_of(h_s, options);
  set_motions(time, options.driver);
  update_neighbors(h_s);
  if (wake_within_reach(h_s)) set_motions(time, options.driver);
  const double approach_m_s = find_contacts(h_s, options.lookahead_s);
  was_impact_ = options.splits_at_events &&
                approach_m_s > std::min(impact_m_s, impact_m_s2 * options.lookahead_s);
  if (was_impact_) {
    solve_impact(options.driver);
    return 0;
  }
  solve(time, options);
  const Event event = options.splits_at_events ? next_event(h_s) : Event{};
  if (event.fraction < 1) {
    h_s = std::min(h_s, std::max(event.fraction * h_s, min_step_s));
    const StepTime shorter = time_of(h_s, options);
    set_motions(shorter, options.driver);
    solve(shorter, options);
  }
  move(h_s, event.changes_force);
  return h_s;
}

ContactSurface BoxWorld::surface(const Pair& pair) const {
  ContactSurface surface = surface_;
  if (pair.with_table())
    surface.friction = bodies_[pair.first].table_friction.value_or(surface_.friction);
  return surface;
}

// The law of compliant contacts needs no lookahead beyond the next step.
StepTime BoxWorld::time_of(double h_s, const StepOptions& options) const {
  return {h_s, surface_.is_rigid() ? options.lookahead_s : h_s};
}

void BoxWorld::set_motions(const StepTime& time, const Driver& driver) {
  for (Body& body : bodies_) {
    if (body.driven)
      driver.set_motion(body, time);
    else if (!body.asleep)
      body.set_free_motion(gravity_m_s2_, time);
  }
}

// Compliant contacts have the geometry of the middle of the step: lever arms and normals turn with
// a cube. Rigid ones have that of the start, where their points touch exactly.
// @return the largest approach speed of points in contact, m/s
double BoxWorld::find_contacts(double h_s, double regular_s) {
  const double ahead_s = surface_.is_rigid() ? 0 : h_s / 2;
  for (Body& body : bodies_) body.look_ahead(ahead_s);
  double approach_m_s = 0;
  touching_.clear();
  for (Pair& pair : pairs_) {
    Body& first = bodies_[pair.first];
    Body& second = pair.with_table() ? table_ : bodies_[pair.second];
    if (first.asleep && (pair.with_table() || second.asleep)) continue;
    const bool movable = first.step.inverse_mass > 0 || second.step.inverse_mass > 0;
    const double margin_m = first.travel_bound_m + second.travel_bound_m;
    if (!movable || !first.solid || (!second.solid && !pair.with_table()))
      pair.manifold.clear();
    else if (!pair.manifold.is_current(margin_m))
      pair.manifold.update(contact(pair, h_s, margin_m), first, second, surface(pair), margin_m);
    if (pair.manifold.empty()) continue;
    approach_m_s = std::max(approach_m_s, pair.manifold.begin_step(regular_s, ahead_s));
    pair.manifold.extrapolate_impulses();
    touching_.push_back(&pair.manifold);
  }
  for (Body& body : bodies_) body.end_look_ahead();
  // Sweeps converge faster from the table up. But where a coupled clone presses a cube into the
  // table there is no solution, and the last contact, with the table, must win.
  if (surface_.shortcuts) std::ranges::reverse(touching_);
  return approach_m_s;
}

void BoxWorld::solve_impact(const Driver& driver) {
  ++counts_.hits;
  set_motions({0, 0}, driver);
  for (Body& body : bodies_) body.step.begin(0);
  for (ContactManifold* manifold : touching_) {
    manifold->begin_impact();
  }
  iterate();
  for (Pair& pair : pairs_)
    pair.impact_n_s = pair.manifold.empty() ? Vector3d::Zero() : pair.manifold.end_impact();
  for (Body& body : bodies_)
    if (body.is_active()) {
      body.velocity = body.step.constrained;
      body.force_duration_s = 0;
    }
}

void BoxWorld::solve(const StepTime& time, const StepOptions& options) {
  for (Body& body : bodies_)
    if (!body.asleep) body.step.begin(time.mean_weight());
  for (ContactManifold* manifold : touching_) {
    manifold->set_step(time);
    if (!options.splits_at_events) manifold->add_speculative_limits();
    manifold->warm_start();
  }
  iterate();
  for (Body& body : bodies_)
    if (!body.asleep) body.step.finish(time.mean_weight(), body.driven);
}

BoxWorld::Event BoxWorld::next_event(double h_s) const {
  Event first_event;
  const auto consider = [&](std::optional<double> fraction, bool changes_force) {
    if (fraction && (1 - *fraction) * h_s > min_remainder_s && *fraction < first_event.fraction)
      first_event = {*fraction, changes_force};
  };
  for (const Pair& pair : pairs_) {
    if (pair.manifold.empty() || bodies_[pair.first].asleep) continue;
    consider(pair.manifold.fraction_before_impact(), !surface_.is_rigid());
    consider(pair.manifold.fraction_before_sticking(), false);
    const bool with_driven = bodies_[pair.first].driven || bodies_[pair.second].driven;
    if (with_driven && !pair.with_table()) consider(fraction_before_separation(pair, h_s), true);
  }
  return first_event;
}

// A clone that slides off a cube springs back by millimeters within a step.
std::optional<double> BoxWorld::fraction_before_separation(const Pair& pair, double h_s) const {
  const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
  const Vector3d& normal = pair.manifold.normal();
  if (!pair.manifold.touches()) return std::nullopt;
  Vector3d travel_m = h_s * (first.step.mean.linear_m_s - second.step.mean.linear_m_s);
  travel_m -= travel_m.dot(normal) * normal;
  if (travel_m.squaredNorm() < separated_m * separated_m) return std::nullopt;
  Box overlapping = first.shape;
  overlapping.center_m -= contact_margin_m * normal;  // makes the boxes overlap
  const auto fraction = parting(overlapping, second.shape, travel_m);
  if (!fraction) return std::nullopt;
  return *fraction + separated_m / travel_m.norm();
}

void BoxWorld::move(double h_s, bool changes_force) {
  for (Body& body : bodies_) {
    if (body.asleep) continue;
    if (body.driven) body.force_duration_s = changes_force ? 0 : h_s;
    if (body.driven && body.step.inverse_mass > 0)
      body.mean_force_n = (body.step.constrained.linear_m_s - body.step.free.linear_m_s) /
                          (body.step.inverse_mass * h_s);
    body.integrate(body.step.mean, h_s);
    body.velocity = body.step.end;
  }
  update_sleep(h_s);
}

void BoxWorld::update_sleep(double h_s) {
  for (Body& body : bodies_) {
    if (body.asleep) continue;
    const auto& [along, about] = body.velocity;
    const bool rests = !body.driven && along.squaredNorm() < resting_m_s * resting_m_s &&
                       about.squaredNorm() < resting_rad_s * resting_rad_s;
    body.at_rest_s = rests ? body.at_rest_s + h_s : 0;
  }
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || !pair.manifold.touches()) continue;
    double& first_s = bodies_[pair.first].at_rest_s;
    double& second_s = bodies_[pair.second].at_rest_s;
    first_s = second_s = std::min(first_s, second_s);
  }
  for (Body& body : bodies_) {
    if (body.asleep || body.at_rest_s < resting_for_s) continue;
    body.asleep = true;
    body.velocity = {};
  }
}

bool BoxWorld::driven_body_within(double reach_m) const {
  return std::ranges::any_of(bodies_, [&](const Body& driven) {
    if (!driven.driven || !driven.solid) return false;
    const double half_height_m = driven.shape.axes.row(2).cwiseAbs().dot(driven.shape.half_m);
    return driven.pose.position_m.z() - half_height_m < reach_m ||
           std::ranges::any_of(bodies_, [&](const Body& body) {
             return !body.driven && within(driven, body, reach_m);
           });
  });
}

double BoxWorld::max_angular_speed_rad_s() const {
  double fastest = 0;
  for (const Body& body : bodies_)
    if (!body.asleep) fastest = std::max(fastest, body.velocity.angular_rad_s.squaredNorm());
  return std::sqrt(fastest);
}

Vector3d BoxWorld::impulse_n_s(std::size_t pusher, std::size_t pushed) const {
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || !pair.has(pusher) || !pair.has(pushed)) continue;
    const Vector3d on_first = was_impact_ ? pair.impact_n_s : pair.manifold.impulse_n_s();
    return pushed == pair.first ? on_first : Vector3d(-on_first);
  }
  return Vector3d::Zero();
}

void BoxWorld::forget_contacts(std::size_t i) {
  for (Body& body : bodies_) body.wake();
  for (Pair& pair : pairs_)
    if (pair.has(i)) pair.manifold.clear();
  listed_reach_m_ = 0;
}

}  // namespace heft::boxes
