// The keys of a staircase of any kind and of interleaving, which procedure files and protocols
// share.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "protocol/TableReader.h"
#include "psychophysics/Interleaving.h"

namespace heft {

/// Reads name, kind and the kind's keys, closes the table and checks the keys against each other;
/// keys that only the caller knows must be read before. None where the kind is none that there is:
/// its keys are not looked at.
std::optional<ProcedureConfig> read_procedure(TableReader& table);

/// Notes every level that would make a comparison, reference_g + level, weigh 0 g or less.
void check_lightest(TableReader& table, const ProcedureConfig& config, double reference_g);

/// What a report says was chosen.
std::string described(const ProcedureConfig& config);

/// Reads `interleave` and `max_lag`.
InterleaveConfig read_interleaving(TableReader& table);

/// Holds the names of a kind of table to being different.
class UniqueNames {
 public:
  /// @param what how messages call the thing, e.g. "staircase"
  explicit UniqueNames(std::string what) : what_(std::move(what)) {}
  /// Notes a mistake at the table's `name` where an earlier table has it.
  void check(TableReader& table, const std::string& name);

 private:
  std::string what_;
  std::map<std::string, int> lines_;
};

}  // namespace heft
