#include "protocol/ProcedureFile.h"

#include <limits>

#include "base/TextFile.h"
#include "protocol/ProcedureReader.h"

namespace heft {

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
    auto procedure = read_procedure(table);
    if (!procedure) continue;
    names.check(table, procedure->name);
    config.staircases.push_back(std::move(*procedure));
  }
  reader.close();
  mistakes.throw_if_any();
  return config;
}

InterleavedProcedures load_procedure(const std::string& path) {
  return parse_procedure(read_text_file(path), path);
}

}  // namespace heft
