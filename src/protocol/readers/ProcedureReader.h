// The keys of a staircase of any kind and of interleaving, which procedure files and protocols
// share.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "protocol/toml/TableReader.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {

/// A staircase as its table has it, which may be one with mistakes.
struct StaircaseSettings {
  std::string name;
  ProcedureKinds::Any config;

  /// Where the settings have mistakes, which the reader has noted, another one stands in.
  Procedure procedure() const;
};

/// Reads name, kind and the kind's keys, closes the table and checks the settings; keys that only
/// the caller knows must be read before. None where the kind is unknown: its keys are not looked
/// at.
std::optional<StaircaseSettings> read_staircase(TableReader& table);

/// Notes what makes the settings unfit for levels that are differences from a reference.
void check_beside(TableReader& table, const StaircaseSettings& settings, double reference_g);

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
