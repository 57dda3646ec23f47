#include "protocol/ProcedureFile.h"

#include <limits>

#include "base/TextFile.h"
#include "protocol/StaircaseReader.h"

namespace heft {

ProcedureConfig parse_procedure(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  ProcedureConfig config;
  reader.require({"staircase"});
  reader.read("seed", config.seed, {0, std::numeric_limits<std::int64_t>::max()});
  config.interleaving = read_interleaving(reader);
  UniqueNames names("staircase");
  for (TableReader& table : reader.tables("staircase")) {
    config.staircases.push_back(read_staircase(table));
    table.close();
    check_staircase(table, config.staircases.back());
    names.check(table, config.staircases.back().name);
  }
  reader.close();
  mistakes.throw_if_any();
  return config;
}

ProcedureConfig load_procedure(const std::string& path) {
  return parse_procedure(read_text_file(path), path);
}

}  // namespace heft
