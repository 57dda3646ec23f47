#include "physics/scene/Scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "base/SimulationChoices.h"

namespace heft {

void Technique::apply_to(Scene& scene) const {
  scene.displacement.reset();
  scene.coupling.decoupled = false;
  if (contact_compliance_m_per_n) scene.contact_compliance_m_per_n = *contact_compliance_m_per_n;
  if (const auto* coupling = std::get_if<Coupling>(&law)) scene.coupling = *coupling;
  if (const auto* displacement = std::get_if<Displacement>(&law))
    scene.displacement = *displacement;
}

Technique technique_named(const std::string& name, const std::vector<Technique>& declared,
                          const Coupling& defaults) {
  if (const auto found = std::ranges::find(declared, name, &Technique::name);
      found != declared.end())
    return *found;
  Coupling coupling = defaults;
  coupling.decoupled = name == spring_technique;
  if (name == coupled_technique || name == spring_technique) return {name, coupling};
  throw std::out_of_range("no technique is named " + name);
}

namespace {
// FNV-1a over 64-bit words, with a shift that carries high bits to low ones.
struct Hasher {
  std::uint64_t hash = 14695981039346656037ULL;
  void add(double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL;
    hash ^= hash >> 32;
  }
  void add(const BodyState& body) {
    for (int i = 0; i < 3; ++i) add(body.pose.position_m[i]);
    for (int i = 0; i < 4; ++i) add(body.pose.orientation.coeffs()[i]);
    for (int i = 0; i < 3; ++i) add(body.velocity.linear_m_s[i]);
    for (int i = 0; i < 3; ++i) add(body.velocity.angular_rad_s[i]);
  }
};
}  // namespace

std::string state_hash(const WorldState& state) {
  Hasher hasher;
  hasher.add(state.clone_present ? 1.0 : 0.0);
  hasher.add(state.clone);
  for (const BodyState& cube : state.cubes) hasher.add(cube);
  return fmt::format("{:016x}", hasher.hash);
}

}  // namespace heft
