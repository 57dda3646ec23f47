// Staircases of protocols, and procedure files.
#include <fmt/format.h>

#include <limits>

#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "protocol/readers/ProtocolTables.h"

namespace heft {

Procedure StaircaseSettings::procedure() const {
  return std::visit(
      [&](const auto& of_kind) {
        return of_kind.check().empty() ? Procedure(name, of_kind)
                                       : Procedure(name, ConstantConfig{.levels = {0}});
      },
      config);
}

std::optional<StaircaseSettings> read_staircase(TableReader& table) {
  StaircaseSettings settings;
  table.require({"name"});
  table.read("name", settings.name);
  const bool has_kind = table.has("kind");
  const auto kind = has_kind ? table.read_nearest_name("kind", ProcedureKinds::names)
                             : table.read_name("kind", ProcedureKinds::names);
  if (has_kind && !kind) return std::nullopt;
  if (kind) settings.config = ProcedureKinds::defaults(*kind);
  std::visit(
      [&](auto& config) {
        table.read_keys(config);
        table.close();
        table.note(config.check());
      },
      settings.config);
  return settings;
}

void check_beside(TableReader& table, const StaircaseSettings& settings, double reference_g,
                  bool either_sign) {
  table.note(
      std::visit([&](const auto& config) { return config.check_beside(reference_g, either_sign); },
                 settings.config));
}

InterleaveConfig read_interleaving(TableReader& table) {
  InterleaveConfig config;
  table.read_keys(config);
  return config;
}

void UniqueNames::check(TableReader& table, const std::string& name) {
  if (!table.has("name") || !table.good({"name"})) return;
  const auto [first, is_new] = lines_.try_emplace(name, table.place().line);
  if (!is_new)
    table.mistake("name", fmt::format("another {} is named \"{}\" (line {}), expected "
                                      "another name",
                                      what_, printable(name), first->second));
}

InterleavedProcedures parse_procedure(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  InterleavedProcedures config;
  reader.require({"staircase"});
  reader.read("seed", config.seed, {0, std::numeric_limits<std::int64_t>::max()});
  config.interleaving = read_interleaving(reader);
  UniqueNames names("staircase");
  for (TableReader& table : reader.tables("staircase")) {
    const auto settings = read_staircase(table);
    if (!settings) continue;
    names.check(table, settings->name);
    config.staircases.push_back(settings->procedure());
  }
  reader.close();
  mistakes.throw_if_any();
  return config;
}

InterleavedProcedures load_procedure(const std::string& path) {
  return parse_procedure(read_text_file(path), path);
}

}  // namespace heft
