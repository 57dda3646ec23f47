// The keys of a staircase and of interleaving, which procedure files and protocols share.
#pragma once

#include <map>
#include <string>

#include "protocol/TableReader.h"
#include "psychophysics/Interleaving.h"

namespace heft {

/// Reads every key of a staircase. Call table.close() next, then check_staircase.
StaircaseConfig read_staircase(TableReader& table);

/// Notes what is wrong between the keys of a staircase.
void check_staircase(TableReader& table, const StaircaseConfig& config);

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
