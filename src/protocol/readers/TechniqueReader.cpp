// Effector, coupling and techniques in protocols and scene files.
#include <fmt/format.h>

#include <algorithm>

#include "base/SimulationChoices.h"
#include "base/files/Printable.h"
#include "physics/coupling/CouplingLaw.h"
#include "protocol/readers/ProtocolTables.h"

namespace heft {

void read_effector(TableReader& reader, Eigen::Vector3d& size_m) {
  reader.in_table("effector", [&](auto& table) { table.read("size_m", size_m, size_on_earth); });
}

Coupling read_coupling(TableReader& table, Coupling coupling, double rate_hz) {
  table.read("stiffness_n_per_m", coupling.stiffness_n_per_m, above_zero);
  table.read("torsional_stiffness_nm_per_rad", coupling.torsional_stiffness_nm_per_rad, above_zero);
  table.read("clone_mass_kg", coupling.clone_mass_kg, above_zero);
  table.read("damping_ratio", coupling.damping_ratio, zero_or_more);
  const auto why = instability(coupling, rate_hz);
  if (why && table.good({"damping_ratio", "stiffness_n_per_m", "clone_mass_kg"}))
    table.mistake("damping_ratio", *why);
  return coupling;
}

void TableReader::read(std::string_view key, MassCurve& field, const Range& values) {
  std::vector<Eigen::Vector2d> rows;
  read(key, rows, above_zero, values);
  std::vector<MassCurve::Point> points;
  for (const Eigen::Vector2d& row : rows) {
    if (!points.empty() && row.x() <= 1e3 * points.back().mass_kg)
      mistake(key, points.size(),
              fmt::format("{} changes from {:g} to {:g} g, expected ascending masses", key,
                          1e3 * points.back().mass_kg, row.x()));
    points.push_back({row.x() / 1e3, row.y()});
  }
  if (!points.empty()) field = MassCurve(points);
}

namespace {
constexpr std::string_view spring_kind = "spring", coupled_kind = "coupled";

Technique read_technique(TableReader& table, const Coupling& defaults, double rate_hz) {
  std::vector<std::string_view> kinds{spring_kind, coupled_kind};
  kinds.insert(kinds.end(), Displacements::names.begin(), Displacements::names.end());
  Technique technique;
  table.require({"name"});
  table.read("name", technique.name);
  table.read("contact_compliance_m_per_n", technique.contact_compliance_m_per_n, compliances);
  const auto kind = table.read_nearest_name("kind", kinds);
  if (!kind) return technique;  // its other keys depend on it
  if (*kind == spring_kind) {
    technique.law = read_coupling(table, defaults, rate_hz);
  } else if (*kind == coupled_kind) {
    Coupling coupling = defaults;
    coupling.decoupled = false;
    technique.law = coupling;
  } else {
    Displacement displacement = Displacements::defaults(*kind);
    std::visit([&](auto& law) { table.read_keys(law); }, displacement);
    technique.law = displacement;
  }
  table.close();
  return technique;
}
}  // namespace

std::vector<Technique> read_techniques(TableReader& reader, const Coupling& defaults,
                                       double rate_hz) {
  std::vector<Technique> techniques;
  UniqueNames names("technique");
  for (TableReader& table : reader.tables("technique")) {
    techniques.push_back(read_technique(table, defaults, rate_hz));
    names.check(table, techniques.back().name);
  }
  return techniques;
}

TechniqueNames::TechniqueNames(const std::vector<Technique>& declared)
    : names_{coupled_technique, spring_technique} {
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
