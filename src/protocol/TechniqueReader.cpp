#include "protocol/TechniqueReader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Printable.h"
#include "protocol/PhysicsReader.h"
#include "protocol/ProcedureReader.h"

namespace heft {

namespace {
Technique read_technique(TableReader& table, const Coupling& defaults) {
  Technique technique;
  table.require({"name", "kind"});
  table.read("name", technique.name);
  table.read("kind", technique.kind);
  if (technique.kind == TechniqueKind::spring) technique.coupling = read_coupling(table, defaults);
  table.close();
  return technique;
}
}  // namespace

std::vector<Technique> read_techniques(TableReader& reader, const Coupling& defaults) {
  std::vector<Technique> techniques;
  UniqueNames names("technique");
  for (TableReader& table : reader.tables("technique")) {
    techniques.push_back(read_technique(table, defaults));
    names.check(table, techniques.back().name);
  }
  return techniques;
}

TechniqueNames::TechniqueNames(const std::vector<Technique>& declared) : names_{"C1", "C2"} {
  for (const Technique& technique : declared)
    if (std::ranges::find(names_, technique.name) == names_.end()) names_.push_back(technique.name);
}

void TechniqueNames::read(TableReader& table, std::string& name) const {
  const std::string_view key = table.has("technique") ? "technique" : "condition";
  const std::vector<std::string_view> names(names_.begin(), names_.end());
  if (const auto found = table.read_name(key, names)) name = *found;
}

void TechniqueNames::check(TableReader& table, std::string_view key,
                           const std::string& name) const {
  if (std::ranges::find(names_, name) != names_.end()) return;
  const std::vector<std::string_view> names(names_.begin(), names_.end());
  table.mistake(key, fmt::format("there is no technique \"{}\", expected {}", printable(name),
                                 quoted_list(names)));
}

}  // namespace heft
