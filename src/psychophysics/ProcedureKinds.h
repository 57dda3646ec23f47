// The closed list of the kinds of procedures that files can name. A further one is an entry here
// and a file beside this one: its settings, with visit_keys, check and check_beside, and the kind.
#pragma once

#include <string>

#include "base/Names.h"
#include "psychophysics/Constant.h"
#include "psychophysics/Procedure.h"
#include "psychophysics/UpDown.h"

namespace heft {

template <typename... KindConfig>
struct KindsOfProcedure : NamedKinds<KindConfig...> {
  /// What a report says was chosen; empty for a kind that no file can name.
  static std::string described(const Procedure& procedure) {
    std::string text;
    const auto describe = [&](const auto* kind) {
      if (kind) text = keys_report(kind->config());
    };
    (describe(procedure.get_if<typename KindConfig::Procedure>()), ...);
    return text;
  }

  /// Where it starts and how it moves, as an adaptive kind says it; empty for the others.
  /// @param unit of levels
  static std::string course(const Procedure& procedure, std::string_view unit) {
    std::string text;
    const auto describe = [&](const auto* kind) {
      if constexpr (requires { kind->config().course(unit); })
        if (kind) text = kind->config().course(unit);
    };
    (describe(procedure.get_if<typename KindConfig::Procedure>()), ...);
    return text;
  }

  /// Whether it estimates a level; a kind that does not declares `estimates_nothing`.
  static bool estimates_level(const Procedure& procedure) {
    const auto is_without = [&]<typename Config>() {
      if constexpr (requires { Config::estimates_nothing; })
        return procedure.get_if<typename Config::Procedure>() != nullptr;
      return false;
    };
    return !(is_without.template operator()<KindConfig>() || ...);
  }
};

/// The first is what a file means that names none.
using ProcedureKinds = KindsOfProcedure<UpDownConfig, ConstantConfig>;

}  // namespace heft
