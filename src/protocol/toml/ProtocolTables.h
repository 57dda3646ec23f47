// The tables of a protocol that have readers of their own, some shared with scene files, and --set.
#pragma once

#include <string>
#include <vector>

#include "experiment/SessionConfig.h"
#include "physics/scene/Scene.h"
#include "protocol/Protocol.h"
#include "protocol/toml/TableReader.h"
#include "protocol/toml/TomlDocument.h"

namespace heft {

/// Reads and closes the table [effector], where there is one.
void read_effector(TableReader& reader, Eigen::Vector3d& size_m);

/// Reads the coupling's numbers; the caller closes the table. Absent keys are as given: the paper's
/// (section 4.2, Parameters), unless somebody says otherwise.
Coupling read_coupling(TableReader& table, Coupling coupling = {});

/// Techniques as protocols and scenes declare them, [[technique]] each; those of
/// base/SimulationChoices.h need no declaration.
/// @param defaults of what a spring does not say: the [coupling] table
std::vector<Technique> read_techniques(TableReader& reader, const Coupling& defaults);

/// The names of all techniques that there are, declared or not.
class TechniqueNames {
 public:
  explicit TechniqueNames(const std::vector<Technique>& declared);
  /// Reads a technique's name at `technique` or, as it was called first, at `condition`.
  void read(TableReader& table, std::string& name) const;
  /// Notes a mistake at `key` where the name is no technique's.
  void check(TableReader& table, std::string_view key, const std::string& name) const;

 private:
  std::vector<std::string> names_;
};

/// Reads and checks every block; those with mistakes may be left out.
std::vector<Block> read_blocks(TableReader& protocol, const TechniqueNames& techniques);

/// Puts the blocks that the key `block_order` names into that order, at the places that they have
/// together in the file; others stay where they are.
void read_block_order(TableReader& protocol, std::vector<Block>& blocks);

/// Changes to a parsed file from the command line: "coupling.stiffness_n_per_m=100",
/// "block.sorting.trials=4" (an array's table is named by its `name`, or by its kind).
/// Puts each setting's value, written as in TOML, at its place in the tree. A key that the tree
/// does not hold is added, for the file's own reader to judge.
/// @throws Error (usage) for a setting without "=", with a value that is no TOML, or on no table
void apply_settings(TomlTable& root, const std::vector<ProtocolSetting>& settings);

}  // namespace heft
