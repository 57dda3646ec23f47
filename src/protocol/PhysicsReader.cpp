#include "protocol/PhysicsReader.h"

namespace heft {

void read_effector(TableReader& reader, Eigen::Vector3d& size_m) {
  auto table = reader.table("effector");
  if (!table) return;
  table->read("size_m", size_m, size_on_earth);
  table->close();
}

Coupling read_coupling(TableReader& table, Coupling coupling) {
  table.read("stiffness_n_per_m", coupling.stiffness_n_per_m, above_zero);
  table.read("torsional_stiffness_nm_per_rad", coupling.torsional_stiffness_nm_per_rad, above_zero);
  table.read("clone_mass_kg", coupling.clone_mass_kg, above_zero);
  table.read("damping_ratio", coupling.damping_ratio, zero_or_more);
  return coupling;
}

}  // namespace heft
