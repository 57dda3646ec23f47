// The keys of staircases of any kind and of interleaving, common to procedure files and protocols.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "protocol/toml/TableReader.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {

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
void check_beside(TableReader& table, const StaircaseSettings& settings, double reference_g);

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
