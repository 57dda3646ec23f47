#include "protocol/ProcedureReader.h"

#include <fmt/format.h>

#include "base/Printable.h"
#include "protocol/KindReaders.h"
#include "psychophysics/Procedure.h"

namespace heft {

std::optional<ProcedureConfig> read_procedure(TableReader& table) {
  std::string name;
  table.require({"name"});
  table.read("name", name);
  const bool has_kind = table.has("kind");
  const auto kind = has_kind ? table.read_nearest_name("kind", ProcedureKinds::names)
                             : table.read_name("kind", ProcedureKinds::names);
  if (has_kind && !kind) return std::nullopt;
  KindConfig config;
  if (kind) config = ProcedureKinds::defaults(*kind);
  std::visit([&](auto& keys) { read_keys(table, keys); }, config);
  table.close();
  std::visit([&](const auto& keys) { check_keys(table, keys); }, config);
  return ProcedureConfig{name, config};
}

void check_lightest(TableReader& table, const ProcedureConfig& config, double reference_g) {
  std::visit([&](const auto& kind) { check_lightest(table, kind, reference_g); }, *config.kind);
}

std::string described(const ProcedureConfig& config) {
  return std::visit([](const auto& kind) { return described(kind); }, *config.kind);
}

InterleaveConfig read_interleaving(TableReader& table) {
  InterleaveConfig config;
  table.read("interleave", config.interleave);
  table.read("max_lag", config.max_lag);
  return config;
}

void UniqueNames::check(TableReader& table, const std::string& name) {
  if (!table.has("name") || !table.good({"name"})) return;
  const auto [first, is_new] = lines_.try_emplace(name, table.place().line);
  if (!is_new)
    table.mistake("name", fmt::format("there is already a {} named \"{}\" (line {}), expected "
                                      "another name",
                                      what_, printable(name), first->second));
}

}  // namespace heft
