// The settings of a procedure of any kind, for those who only pass them on: a block that holds them
// does not depend on the kinds, which Procedure.h knows.
#pragma once

#include <memory>
#include <string>

namespace heft {

/// A variant of the settings of every kind: Procedure.h.
struct KindConfig;

struct ProcedureConfig {
  ProcedureConfig();  ///< without a name, of the first kind with its defaults
  ProcedureConfig(std::string name, const KindConfig& kind);

  std::string name;
  std::shared_ptr<const KindConfig> kind;  ///< never null
};

}  // namespace heft
