#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "base/Names.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "experiment/Participant.h"
#include "protocol/Protocol.h"
#include "protocol/study/StudyPlan.h"
#include "protocol/toml/TableReader.h"

namespace heft {

namespace {
constexpr int most_participants = 100000;
constexpr std::size_t most_blocks = 20, most_orders = 1000;

// Paths are relative to the study's file.
std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

void read_path(TableReader& table, std::string_view key, const std::string& file,
               std::optional<std::string>& field) {
  std::string path;
  table.read(key, path);
  if (!path.empty()) field = beside(file, path);
}

// The code of an installed language, or a file of texts.
void read_language(TableReader& table, const std::string& file, std::optional<std::string>& field) {
  std::string language;
  table.read("language", language);
  if (language.empty()) return;
  field = language.ends_with(".toml") ? beside(file, language) : language;
}

// Named blocks, each once.
void check_blocks(TableReader& table, std::string_view key,
                  const std::vector<std::string>& blocks) {
  if (!table.has(key) || !table.good({key})) return;
  if (blocks.size() < 2 || blocks.size() > most_blocks)
    table.mistake(key, fmt::format("{} has {}, expected 2 to {}: others keep their places", key,
                                   counted(std::ssize(blocks), "block"), most_blocks));
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (std::ranges::count(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(i),
                           blocks[i]) > 0)
      table.mistake(key, i,
                    fmt::format("\"{}\" is listed twice, expected each block once", blocks[i]));
}

// The orders, and the place of their blocks: in the table of the design, or in its first row.
struct Orders {
  std::vector<BlockOrder> orders{{}};
  BlockOrder blocks;  ///< in the file's order; empty: nothing to order
  std::optional<TableReader> named_in;
};

void read_rows(TableReader& table, Orders& orders) {
  orders.orders.clear();
  table.require({"row"});
  for (TableReader& row : table.tables("row")) {
    BlockOrder order;
    row.require({"blocks"});
    row.read("blocks", order);
    row.close();
    check_blocks(row, "blocks", order);
    if (!row.good({"blocks"})) continue;
    if (orders.orders.empty()) {
      orders.blocks = order;
      orders.named_in = row;
    } else if (!std::ranges::is_permutation(order, orders.blocks)) {
      row.mistake(
          "blocks",
          fmt::format("blocks differ from those of the first row ({}), expected the same ones "
                      "in another order",
                      described(orders.blocks)));
    }
    orders.orders.push_back(std::move(order));
  }
  if (orders.orders.size() > most_orders)
    table.mistake("row", fmt::format("there are {} rows, expected at most {}", orders.orders.size(),
                                     most_orders));
}

void read_design(TableReader& table, OrderDesign design, std::uint64_t seed, Orders& orders) {
  table.require({"blocks"});
  table.read("blocks", orders.blocks);
  check_blocks(table, "blocks", orders.blocks);
  if (orders.blocks.size() < 2 || !table.good({"blocks"})) return;
  orders.orders = designed_orders(design, orders.blocks, seed);
  orders.named_in = table;
}

Orders read_orders(TableReader& study, std::uint64_t seed) {
  Orders orders;
  study.in_table("order", [&](TableReader& table) {
    OrderDesign design = OrderDesign::balanced;
    table.read("design", design);
    if (design == OrderDesign::rows) return read_rows(table, orders);
    read_design(table, design, seed, orders);
  });
  return orders;
}

// A protocol's mistake as one of the study file.
std::string in_a_line(const InvalidFile& error) {
  const Mistake& first = error.mistakes().front();
  const std::size_t others = error.mistakes().size() - 1;
  return fmt::format("this protocol is not valid: {}: {}{}", to_string(first.place), first.message,
                     others > 0 ? fmt::format(" (and {} more)", others) : "");
}

std::vector<std::string> block_names(const Protocol& protocol) {
  std::vector<std::string> names;
  for (const Block& block : protocol.blocks)
    if (!std::holds_alternative<BreakBlock>(block)) names.push_back(block_name(block));
  return names;
}

// A group's name and settings; others are the study's.
StudyGroup read_group(TableReader& table, const std::string& file, const StudyGroup& study) {
  StudyGroup group = study;
  std::optional<std::string> protocol;
  table.require({"name"});
  table.read("name", group.name);
  read_path(table, "protocol", file, protocol);
  read_language(table, file, group.language);
  if (protocol) group.protocol = *protocol;
  table.close();
  return group;
}

class StudyReader {
 public:
  StudyReader(const TomlTable& root, const std::string& file, Mistakes& mistakes)
      : file_(file), reader_(root, mistakes) {}

  StudyPlan read() {
    read_study();
    orders_ = read_orders(reader_, plan_.seed);
    plan_.orders = orders_.orders;
    read_groups();
    reader_.close();
    return std::move(plan_);
  }

 private:
  void read_study() {
    std::optional<std::string> protocol;
    reader_.require({"study", "participants"});
    reader_.read("study", plan_.name);
    reader_.read("participants", plan_.participants, {1, most_participants});
    reader_.read("seed", plan_.seed, {0, std::numeric_limits<std::int64_t>::max()});
    reader_.read("id_prefix", plan_.id_prefix);
    check_id_prefix();
    read_path(reader_, "protocol", file_, protocol);
    read_language(reader_, file_, study_.language);
    int display = -1;
    reader_.read("display", display, {0, 99});
    if (display >= 0) plan_.display = display;
    read_path(reader_, "display_file", file_, plan_.display_file);
    read_path(reader_, "db", file_, plan_.db);
    read_path(reader_, "backup", file_, plan_.backup);
    reader_.read("operator", plan_.run_by);
    study_.protocol = protocol.value_or("");
  }

  // Checks the prefix of ids before the first participant comes.
  void check_id_prefix() {
    const std::string& prefix = plan_.id_prefix;
    if (!reader_.good({"id_prefix"})) return;
    const auto mistake = [&](const std::string& what) {
      reader_.mistake("id_prefix", fmt::format("id_prefix \"{}\" {}", printable(prefix), what));
    };
    if (const auto wrong = wrong_with_id(planned_id(plan_, plan_.participants)))
      return mistake(fmt::format("is invalid: the id {}", *wrong));
    if (prefix.starts_with(' ')) mistake("begins with a blank, which is invisible");
  }

  void read_groups() {
    if (!reader_.has("group")) {
      if (study_.protocol.empty() && reader_.good({"protocol"}))
        reader_.mistake("protocol", "the file lacks \"protocol\", and no [[group]] has one");
      check_protocol(reader_, study_);
      plan_.groups = {study_};
      return;
    }
    for (TableReader& table : reader_.tables("group")) {
      const StudyGroup group = read_group(table, file_, study_);
      check_name(table, group);
      check_protocol(table, group);
      plan_.groups.push_back(group);
    }
  }

  void check_name(TableReader& table, const StudyGroup& group) {
    if (!table.has("name") || !table.good({"name"})) return;
    if (std::ranges::count(plan_.groups, group.name, &StudyGroup::name) > 0)
      table.mistake("name", fmt::format("another group is named \"{}\"", group.name));
  }

  void check_protocol(TableReader& table, const StudyGroup& group) {
    if (!table.good({"protocol"}) || !reader_.good({"protocol"})) return;
    if (group.protocol.empty()) {
      if (reader_.has("group"))
        table.mistake("protocol", "neither this group nor the file has a \"protocol\"");
      return;
    }
    // Where the protocol is named; the study's protocol is checked once, not for each group.
    TableReader& named = table.has("protocol") ? table : reader_;
    if (!checked_.insert(group.protocol).second) return;
    try {
      check_blocks_of(load_protocol(group.protocol), group.protocol);
    } catch (const InvalidFile& error) {
      named.mistake("protocol", in_a_line(error));
    } catch (const Error& error) {
      named.mistake("protocol", error.what());
    }
  }

  // Requires that each protocol has all blocks to be ordered.
  void check_blocks_of(const Protocol& protocol, const std::string& path) {
    const std::vector<std::string> names = block_names(protocol);
    const std::vector<std::string_view> views(names.begin(), names.end());
    for (std::size_t i = 0; orders_.named_in && i < orders_.blocks.size(); ++i)
      if (std::ranges::count(names, orders_.blocks[i]) == 0)
        orders_.named_in->mistake(
            "blocks", i,
            fmt::format("{} has no block \"{}\" that can be moved, expected {}", path,
                        printable(orders_.blocks[i]), quoted_list(views)));
  }

  const std::string& file_;
  TableReader reader_;
  StudyPlan plan_;
  StudyGroup study_;
  Orders orders_;
  std::set<std::string> checked_;
};
}  // namespace

StudyPlan parse_study(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  StudyPlan plan = StudyReader(root, file, mistakes).read();
  mistakes.throw_if_any();
  plan.sha256 = sha256(text);
  return plan;
}

StudyPlan load_study(const std::string& path) {
  return parse_study(read_text_file(path), path);
}

}  // namespace heft
