#include "physics/scene/Scene.h"

#include <algorithm>
#include <stdexcept>

#include "base/SimulationChoices.h"

namespace heft {

void Technique::apply_to(Scene& scene) const {
  scene.displacement.reset();
  scene.coupling.decoupled = false;
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

}  // namespace heft
