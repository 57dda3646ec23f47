// The closed list of procedures that files can name. A further kind is an entry here and a header
// beside this one with its configuration (visit_keys, check, check_beside) and the procedure.
#pragma once

#include <string>

#include "base/Names.h"
#include "psychophysics/Constant.h"
#include "psychophysics/LeastEntropy.h"
#include "psychophysics/Procedure.h"
#include "psychophysics/Quest.h"
#include "psychophysics/UpDown.h"

namespace heft {

template <typename... KindConfig>
struct KindsOfProcedure : NamedKinds<KindConfig...> {
  /// The settings as a report prints them; empty for a kind that files cannot name.
  static std::string described(const Procedure& procedure) {
    std::string text;
    const auto describe = [&](const auto* kind) {
      if (kind) text = keys_report(kind->config());
    };
    (describe(procedure.get_if<typename KindConfig::Procedure>()), ...);
    return text;
  }

  /// Start and steps of an adaptive kind, for reports; empty for the others.
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

  /// Whether a method of estimation is that of a Bayesian kind, which is named after it.
  static bool is_bayesian(std::string_view method) {
    const auto is_method = [&]<typename Config>() {
      if constexpr (requires(const typename Config::Procedure& kind) { kind.posterior(); })
        return method == Config::kind;
      return false;
    };
    return (is_method.template operator()<KindConfig>() || ...);
  }

  /// Whether it estimates a level. Kinds that do not declare `estimates_nothing`.
  static bool estimates_level(const Procedure& procedure) {
    const auto is_without = [&]<typename Config>() {
      if constexpr (requires { Config::estimates_nothing; })
        return procedure.get_if<typename Config::Procedure>() != nullptr;
      return false;
    };
    return !(is_without.template operator()<KindConfig>() || ...);
  }
};

/// The first is the default of files.
using ProcedureKinds =
    KindsOfProcedure<UpDownConfig, ConstantConfig, QuestConfig, QuestPlusConfig, PsiConfig>;

}  // namespace heft
