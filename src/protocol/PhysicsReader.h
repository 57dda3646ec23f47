// The keys of the effector and its coupling, which scene files and protocols share.
#pragma once

#include "physics/Scene.h"
#include "protocol/TableReader.h"

namespace heft {

/// Reads and closes the table [effector], where there is one.
void read_effector(TableReader& reader, Eigen::Vector3d& size_m);

/// Reads the coupling's numbers; the caller closes the table. Absent keys are as given: the paper's
/// (section 4.2, Parameters), unless somebody says otherwise.
Coupling read_coupling(TableReader& table, Coupling coupling = {});

}  // namespace heft
