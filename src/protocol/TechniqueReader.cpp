// Effector, coupling and techniques, as protocols and scene files have them.
#include <fmt/format.h>

#include <algorithm>

#include "base/DefaultTechniques.h"
#include "base/Printable.h"
#include "protocol/ProcedureReader.h"
#include "protocol/ProtocolTables.h"

namespace heft {

enum class TechniqueKind { spring, coupled, gain, speed_limit };
template <>
struct EnumNames<TechniqueKind> {
  static constexpr std::array<std::string_view, 4> names{"spring", "coupled", "gain",
                                                         "speed_limit"};
};

void read_effector(TableReader& reader, Eigen::Vector3d& size_m) {
  reader.in_table("effector", [&](auto& table) { table.read("size_m", size_m, size_on_earth); });
}

Coupling read_coupling(TableReader& table, Coupling coupling) {
  table.read("stiffness_n_per_m", coupling.stiffness_n_per_m, above_zero);
  table.read("torsional_stiffness_nm_per_rad", coupling.torsional_stiffness_nm_per_rad, above_zero);
  table.read("clone_mass_kg", coupling.clone_mass_kg, above_zero);
  table.read("damping_ratio", coupling.damping_ratio, zero_or_more);
  return coupling;
}

namespace {
constexpr Range gains{0, 10};
constexpr Range speeds_m_s{0, 100};

MassCurve read_curve(TableReader& table, std::string_view key, const Range& values) {
  std::vector<Eigen::Vector2d> rows;
  table.require({key});
  table.read(key, rows, above_zero, values);
  std::vector<MassCurve::Point> points;
  for (const Eigen::Vector2d& row : rows) {
    if (!points.empty() && row.x() <= 1e3 * points.back().mass_kg)
      table.mistake(key, points.size(),
                    fmt::format("{} goes from {:g} to {:g} g, expected ascending masses", key,
                                1e3 * points.back().mass_kg, row.x()));
    points.push_back({row.x() / 1e3, row.y()});
  }
  return points.empty() ? MassCurve() : MassCurve(points);
}

template <typename Law>
Law read_displacement(TableReader& table, std::string_view key, const Range& values) {
  Law law;
  law.of_mass = read_curve(table, key, values);
  table.read("return_s", law.return_s, above_zero);
  return law;
}

std::variant<Coupling, Gain, SpeedLimit> read_law(TableReader& table, TechniqueKind kind,
                                                  const Coupling& defaults) {
  switch (kind) {
    case TechniqueKind::gain:
      return read_displacement<Gain>(table, "gain_of_mass", gains);
    case TechniqueKind::speed_limit:
      return read_displacement<SpeedLimit>(table, "limit_m_s_of_mass", speeds_m_s);
    case TechniqueKind::spring:
      return read_coupling(table, defaults);
    case TechniqueKind::coupled:
      break;
  }
  Coupling coupled = defaults;
  coupled.decoupled = false;
  return coupled;
}

Technique read_technique(TableReader& table, const Coupling& defaults) {
  Technique technique;
  table.require({"name"});
  table.read("name", technique.name);
  const auto kind = table.read_nearest_name("kind", EnumNames<TechniqueKind>::names);
  if (!kind) return technique;  // what else it should say is not known
  technique.law = read_law(table, *named<TechniqueKind>(*kind), defaults);
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
