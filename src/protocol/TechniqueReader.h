// Techniques as protocols and scenes declare them, [[technique]] each, and where they are named.
// "C1" and "C2" need no declaration (paper, 4.1).
#pragma once

#include <string>
#include <vector>

#include "physics/Scene.h"
#include "protocol/TableReader.h"

namespace heft {

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

}  // namespace heft
