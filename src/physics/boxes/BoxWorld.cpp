#include "physics/boxes/BoxWorld.h"

#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double resting_m_s = 1e-4, resting_rad_s = 5e-3, resting_for_s = 0.25;
// Contacts are looked for this far ahead, beside what the boxes cover in a step: the speculative
// margin.
constexpr double near_m = 0.1e-3;
constexpr double faster_m_s = 0.1;  // than at its start a body may become within a step
// How far beyond the margin neighbours are listed: so far bodies move before it is done again.
constexpr double listed_beyond_m = 0.02;
constexpr double far_m = 0.1e-3;  // a travel worth finding out where on the way boxes meet
constexpr double clear_m = 1e-6;  // boxes that slid off each other are so far apart
constexpr double exactly_m = 1e-9;
// What closes in faster hits. Slower, a step gives back a third of it: so much as friction and
// weight take away within the step.
constexpr double hit_m_s = 0.01, hit_m_s2 = 10;
constexpr double least_step_s = 1e-6;  // up to an event
constexpr double least_cut_s = 5e-6;   // of a step that is worth cutting off
constexpr double farthest = 100;       // that sweeps are extrapolated, in sweeps
constexpr int most_sweeps = 300;
constexpr double settled_m_s = 1e-5;   // sweeps end when no velocity changes by more
constexpr double squeezed_m_s = 0.01;  // what never ends has no answer
}  // namespace

BoxWorld::BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies)
    : surface_(surface), gravity_m_s2_(gravity_m_s2) {
  const std::size_t n_pairs = n_bodies * (n_bodies + 1) / 2;
  bodies_.reserve(n_bodies);
  listed_m_.reserve(n_bodies);
  for (auto* pairs : {&pairs_, &old_pairs_}) pairs->reserve(n_pairs);
  touching_.reserve(n_pairs);
  table_.solid = false;  // not one of the boxes
}

std::size_t BoxWorld::add(const Body& body) {
  bodies_.push_back(body);
  listed_m_.push_back(body.pose.position_m);
  listed_reach_m_ = 0;
  return bodies_.size() - 1;
}

void BoxWorld::settle_at_start() {
  for (Body& body : bodies_) {
    const Contact standing = contact_with_table(body.shape, near_m);
    body.asleep = !body.driven && standing.n_points == 4;
    for (const ContactPoint& point : standing.all())
      if (std::abs(point.distance_m) > exactly_m) body.asleep = false;
  }
  for (Body& first : bodies_)
    for (Body* second = bodies_.data(); second != &first; ++second)
      if (near(first, *second, near_m) &&
          contact_between(first.shape, second->shape, near_m).n_points > 0)
        first.asleep = second->asleep = false;
  listed_reach_m_ = 0;
}

// How far a body may get in a step.
double BoxWorld::reach_m(const Body& body, double h_s) const {
  if (!body.moves()) return 0;
  const double free_m_s = body.driven ? body.tip_speed_m_s(body.step.mean) : 0;
  return near_m + h_s * (faster_m_s + std::max(free_m_s, body.tip_speed_m_s(body.velocity)));
}

bool BoxWorld::near(const Body& first, const Body& second, double margin_m) const {
  const double reach_m = first.radius_m + second.radius_m + margin_m;
  return (first.pose.position_m - second.pose.position_m).squaredNorm() < reach_m * reach_m;
}

Contact BoxWorld::contact(const Pair& pair, double h_s, double margin_m) const {
  const Body& first = bodies_[pair.first];
  const Body& second = bodies_[pair.second];
  if (pair.with_table()) return contact_with_table(first.shape, margin_m);
  if (!near(first, second, margin_m)) return {};
  const auto velocity = [](const Body& body) {
    return body.driven ? body.step.mean.linear_m_s : body.velocity.linear_m_s;
  };
  const Vector3d travel_m = h_s * (velocity(first) - velocity(second));
  if (pair.manifold.touches() || travel_m.squaredNorm() < far_m * far_m)
    return contact_between(first.shape, second.shape, margin_m);
  return contact_on_the_way(first.shape, second.shape, travel_m, margin_m);
}

// The list holds as long as no two bodies together get farther than it reaches.
void BoxWorld::find_neighbours(double h_s) {
  double farthest_m = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].reach_m = reach_m(bodies_[i], h_s);
    if (bodies_[i].asleep) continue;
    const double gone_m = (bodies_[i].pose.position_m - listed_m_[i]).norm();
    farthest_m = std::max(farthest_m, gone_m + bodies_[i].reach_m);
  }
  if (2 * farthest_m <= listed_reach_m_) return;
  listed_reach_m_ = 2 * farthest_m + listed_beyond_m;
  list_neighbours();
}

void BoxWorld::list_neighbours() {
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
      if (!(first.asleep && second.asleep) && near(first, second, listed_reach_m_)) list(i, j);
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].asleep) list(i, i);
}

// @return whether anything woke
bool BoxWorld::wake_reached(double h_s) {
  bool any = false;
  for (bool more = true; more; any = any || more) {
    more = false;
    for (const Pair& pair : pairs_) {
      Body& first = bodies_[pair.first];
      Body& second = bodies_[pair.second];
      if (first.asleep == second.asleep || !first.solid || !second.solid) continue;
      const double margin_m = first.reach_m + second.reach_m;
      if (!near(first, second, margin_m) || contact(pair, h_s, margin_m).n_points == 0) continue;
      for (Body* woken : {&first, &second}) {
        woken->wake();
        woken->reach_m = reach_m(*woken, h_s);
      }
      more = true;
    }
    if (more) list_neighbours();
  }
  return any;
}

double BoxWorld::advance(double h_s, const SteppedBy& how) {
  set_motions(h_s, how);
  find_neighbours(h_s);
  if (wake_reached(h_s)) set_motions(h_s, how);
  const double closing_m_s = find_contacts(h_s, how.beyond_s);
  hit_ = how.cuts && closing_m_s > std::min(hit_m_s, hit_m_s2 * how.beyond_s);
  if (hit_) {
    hit(how.driver);
    return 0;
  }
  solve(h_s, how);
  const Event event = how.cuts ? next_event(h_s) : Event{};
  if (event.fraction < 1) {
    h_s = std::min(h_s, std::max(event.fraction * h_s, least_step_s));
    set_motions(h_s, how);
    solve(h_s, how);
  }
  move(h_s, event.ends_pushes);
  return h_s;
}

void BoxWorld::set_motions(double h_s, const SteppedBy& how) {
  for (Body& body : bodies_) {
    if (body.driven)
      how.driver.set_motion(body, {h_s, how.beyond_s});
    else if (!body.asleep)
      body.fall(gravity_m_s2_, {h_s, how.beyond_s});
  }
}

// @return the largest speed at which what touches closes in, m/s
double BoxWorld::find_contacts(double h_s, double regular_s) {
  double closing_m_s = 0;
  touching_.clear();
  for (Pair& pair : pairs_) {
    Body& first = bodies_[pair.first];
    Body& second = pair.with_table() ? table_ : bodies_[pair.second];
    if (first.asleep && (pair.with_table() || second.asleep)) continue;
    const bool gives = first.step.per_kg > 0 || second.step.per_kg > 0;
    const double margin_m = first.reach_m + second.reach_m;
    if (!gives || !first.solid || (!second.solid && !pair.with_table()))
      pair.manifold.clear();
    else if (!pair.manifold.still_fits(margin_m))
      pair.manifold.prepare(contact(pair, h_s, margin_m), first, second, surface_, margin_m);
    if (pair.manifold.empty()) continue;
    closing_m_s = std::max(closing_m_s, pair.manifold.start(regular_s));
    pair.manifold.extrapolate();
    touching_.push_back(&pair.manifold);
  }
  // Sweeps settle sooner from the table up. But where a coupled clone squeezes a cube against it
  // there is no answer, and the cube should stay above the table.
  if (surface_.shortcuts) std::ranges::reverse(touching_);
  return closing_m_s;
}

void BoxWorld::hit(const Driver& driver) {
  ++counts_.hits;
  set_motions(0, {driver});
  for (Body& body : bodies_) body.step.begin(0);
  for (Manifold* manifold : touching_) {
    manifold->begin_hit();
  }
  relax();
  for (Pair& pair : pairs_)
    pair.hit_n_s = pair.manifold.empty() ? Vector3d::Zero() : pair.manifold.end_hit();
  for (Body& body : bodies_)
    if (body.moves()) {
      body.velocity = body.step.ahead;
      body.pushed_s = 0;
    }
}

void BoxWorld::solve(double h_s, const SteppedBy& how) {
  const StepTime time{h_s, how.beyond_s};
  for (Body& body : bodies_)
    if (!body.asleep) body.step.begin(time.mean_weight());
  for (Manifold* manifold : touching_) {
    manifold->take_step(time);
    if (!how.cuts) manifold->stop_at_gaps();
    manifold->warm_start();
  }
  relax();
  for (Body& body : bodies_)
    if (!body.asleep) body.step.finish(time.mean_weight(), body.driven);
}

// The impulses of the last step, and mixing, may lead sweeps astray: then they start anew without
// either, where each one takes energy from the bodies. Where a clone squeezes a cube there is no
// answer, and the impulses grow without end: they are no start for the next step.
void BoxWorld::relax() {
  double change_m_s = sweeps(surface_.shortcuts);
  if (change_m_s > squeezed_m_s) {
    forget_impulses();
    for (Body& body : bodies_) body.step.ahead = body.step.free;
    change_m_s = sweeps(false);
  }
  if (change_m_s > settled_m_s) ++counts_.not_converged;
  if (change_m_s > squeezed_m_s) forget_impulses();
}

void BoxWorld::forget_impulses() {
  for (Manifold* manifold : touching_) manifold->forget_impulses();
}

// @return the largest change of a velocity at a point in the last one, m/s
double BoxWorld::sweeps(bool mixed) {
  for (Manifold* manifold : touching_) manifold->begin_sweeps();
  for (Body& body : bodies_) body.step.begin_sweeps();
  last_energy_j_ = 0;
  double change_m_s = 0;
  for (int i = 0; i < most_sweeps; ++i) {
    if (i > 0 && mixed) mix();
    change_m_s = 0;
    for (Manifold* manifold : touching_) change_m_s = std::max(change_m_s, manifold->relax());
    if (change_m_s <= settled_m_s) break;
  }
  return change_m_s;
}

// Anderson's (1965) mixing with one step of memory. Sweeps that settle slowly do so in one
// direction, each change a fixed part of the last one: velocities and impulses go on to where the
// changes would have the least energy. Velocities depend linearly on impulses, so that both go on
// by the same fraction and still belong together. What the last sweep leaves is the result.
void BoxWorld::mix() {
  double energy_j = 0, common_j = 0;
  for (Body& body : bodies_) {
    Motion& motion = body.step;
    if (body.asleep || !(motion.per_kg > 0)) continue;
    const Velocity last = motion.change;
    motion.change = {motion.ahead.linear_m_s - motion.start.linear_m_s,
                     motion.ahead.angular_rad_s - motion.start.angular_rad_s};
    const double mass_kg = 1 / motion.per_kg;
    const double inertia = motion.turns ? 1 / motion.per_kg_m2.diagonal().maxCoeff() : 0;
    const auto& [along, about] = motion.change;
    energy_j += mass_kg * along.squaredNorm() + inertia * about.squaredNorm();
    common_j += mass_kg * along.dot(last.linear_m_s) + inertia * about.dot(last.angular_rad_s);
  }
  const double between_j = energy_j + last_energy_j_ - 2 * common_j;
  const bool known = last_energy_j_ > 0 && between_j > 0;
  const double fraction = known ? std::clamp((common_j - energy_j) / between_j, 0.0, farthest) : 0;
  last_energy_j_ = energy_j;
  for (Body& body : bodies_)
    if (!body.asleep) body.step.go_on(fraction);
  for (Manifold* manifold : touching_) manifold->go_on(fraction);
}

BoxWorld::Event BoxWorld::next_event(double h_s) const {
  Event soonest;
  const auto note = [&](std::optional<double> fraction, bool ends_pushes) {
    if (fraction && (1 - *fraction) * h_s > least_cut_s && *fraction < soonest.fraction)
      soonest = {*fraction, ends_pushes};
  };
  for (const Pair& pair : pairs_) {
    if (pair.manifold.empty() || bodies_[pair.first].asleep) continue;
    note(pair.manifold.fraction_before_hit(), false);
    note(pair.manifold.fraction_before_stop(), false);
    const bool slides = bodies_[pair.first].driven || bodies_[pair.second].driven;
    if (slides && !pair.with_table()) note(fraction_before_sliding_off(pair, h_s), true);
  }
  return soonest;
}

// A drawn clone that slides off a cube snaps back; a step later it would be millimeters elsewhere.
std::optional<double> BoxWorld::fraction_before_sliding_off(const Pair& pair, double h_s) const {
  const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
  const Vector3d& normal = pair.manifold.normal();
  if (!pair.manifold.touches()) return std::nullopt;
  Vector3d travel_m = h_s * (first.step.mean.linear_m_s - second.step.mean.linear_m_s);
  travel_m -= travel_m.dot(normal) * normal;
  if (travel_m.squaredNorm() < clear_m * clear_m) return std::nullopt;
  Box sunk = first.shape;
  sunk.center_m -= near_m * normal;  // so that they overlap
  const auto fraction = parting(sunk, second.shape, travel_m);
  if (!fraction) return std::nullopt;
  return *fraction + clear_m / travel_m.norm();
}

void BoxWorld::move(double h_s, bool ends_pushes) {
  for (Body& body : bodies_) {
    if (body.asleep) continue;
    if (body.driven) body.pushed_s = ends_pushes ? 0 : h_s;
    if (body.driven && body.step.per_kg > 0)
      body.pushed_n =
          (body.step.ahead.linear_m_s - body.step.free.linear_m_s) / (body.step.per_kg * h_s);
    body.move(body.step.mean, h_s);
    body.velocity = body.step.end;
  }
  settle(h_s);
}

void BoxWorld::settle(double h_s) {
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

bool BoxWorld::near_driven(double reach_m) const {
  return std::ranges::any_of(bodies_, [&](const Body& driven) {
    if (!driven.driven || !driven.solid) return false;
    const double half_height_m = driven.shape.axes.row(2).cwiseAbs().dot(driven.shape.half_m);
    return driven.pose.position_m.z() - half_height_m < reach_m ||
           std::ranges::any_of(bodies_, [&](const Body& body) {
             return !body.driven && near(driven, body, reach_m);
           });
  });
}

double BoxWorld::fastest_turn_rad_s() const {
  double fastest = 0;
  for (const Body& body : bodies_)
    if (!body.asleep) fastest = std::max(fastest, body.velocity.angular_rad_s.squaredNorm());
  return std::sqrt(fastest);
}

Vector3d BoxWorld::impulse_n_s(std::size_t pusher, std::size_t pushed) const {
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || !pair.has(pusher) || !pair.has(pushed)) continue;
    const Vector3d on_first = hit_ ? pair.hit_n_s : pair.manifold.impulse_n_s();
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
