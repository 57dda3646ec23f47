// Readers of the tables of a protocol, some common to scene and procedure files, and --set.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/SessionConfig.h"
#include "physics/scene/Scene.h"
#include "protocol/Protocol.h"
#include "protocol/toml/TableReader.h"
#include "protocol/toml/TomlDocument.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/blocks/Staircases.h"

namespace heft {

class UniqueNames;

/// Reads and closes the table [effector], if it exists.
void read_effector(TableReader& reader, Eigen::Vector3d& size_m);

inline constexpr Range compliances{0, 0.01};  ///< of contacts, m/N
inline constexpr double any_rate_hz = std::numeric_limits<double>::infinity();

/// Reads the coupling's numbers; the caller closes the table. Missing keys keep the given values,
/// by default the paper's (section 4.2, Parameters).
/// @param rate_hz of the physics, at which the coupling must be stable
Coupling read_coupling(TableReader& table, Coupling coupling = {}, double rate_hz = any_rate_hz);

/// Reads the [[technique]]s of protocols and scenes; those of base/SimulationChoices.h need no
/// declaration.
/// @param defaults for a spring's missing keys: the [coupling] table
/// @param rate_hz as for read_coupling()
std::vector<Technique> read_techniques(TableReader& reader, const Coupling& defaults,
                                       double rate_hz = any_rate_hz);

/// The names of all techniques, declared or predefined.
class TechniqueNames {
 public:
  explicit TechniqueNames(const std::vector<Technique>& declared);
  /// Reads a technique's name from `technique` or from its former key `condition`.
  void read(TableReader& table, std::string& name) const;
  /// Reports a mistake at `key` unless the name is a technique's.
  void check(TableReader& table, std::string_view key, const std::string& name) const;

 private:
  std::vector<std::string> names_;
};

/// Reads and checks every block; those with mistakes may be left out.
std::vector<Block> read_blocks(TableReader& protocol, const TechniqueNames& techniques);

/// Rearranges the blocks named by the key `block_order` among their places; others are not moved.
void read_block_order(TableReader& protocol, std::vector<Block>& blocks);

/// Applies changes from the command line to a parsed file: "coupling.stiffness_n_per_m=100",
/// "block.sorting.trials=4" (a table of an array is named by its `name` or kind). Values are
/// written as in TOML. Unknown keys are added, for the file's reader to report.
/// @throws Error (usage) for a setting without "=", with an invalid value, or for a missing table
void apply_settings(TomlTable& root, std::span<const ProtocolSetting> settings);

/// The settings of a staircase, perhaps with mistakes.
struct StaircaseSettings {
  std::string name;
  ProcedureKinds::Any config;

  /// A valid procedure; a default one if the settings have (reported) mistakes.
  Procedure procedure() const;
};

/// Reads name, kind and the kind's keys, closes the table and checks the settings; keys of the
/// caller must be read before. None for an unknown kind, whose keys are not checked.
std::optional<StaircaseSettings> read_staircase(TableReader& table);

/// Reports settings that do not suit levels that are differences from a reference.
/// @param either_sign the comparison may be lighter
void check_beside(TableReader& table, const StaircaseSettings& settings, double reference_g,
                  bool either_sign);

/// Reads one [[block.staircase]], which `paired` makes two.
std::vector<ReferenceStaircase> read_staircases_of(TableReader& table,
                                                   const TechniqueNames& techniques,
                                                   UniqueNames& names, const StaircaseRules& rules);

/// Reads `interleave` and `max_lag`.
InterleaveConfig read_interleaving(TableReader& table);

/// Requires different names within a kind of table.
class UniqueNames {
 public:
  /// @param what name of the kind in messages, e.g. "staircase"
  explicit UniqueNames(std::string what) : what_(std::move(what)) {}
  /// Reports a mistake at the table's `name` if an earlier table has it.
  void check(TableReader& table, const std::string& name);

 private:
  std::string what_;
  std::map<std::string, int> lines_;
};

}  // namespace heft
