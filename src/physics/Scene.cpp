#include "physics/Scene.h"

#include <algorithm>
#include <stdexcept>

namespace heft {

Technique technique_named(const std::string& name, const std::vector<Technique>& declared,
                          const Coupling& defaults) {
  if (const auto found = std::ranges::find(declared, name, &Technique::name);
      found != declared.end())
    return *found;
  if (name == "C1") return {name, TechniqueKind::coupled, defaults};
  if (name == "C2") return {name, TechniqueKind::spring, defaults};
  throw std::out_of_range("no technique is named " + name);
}

}  // namespace heft
