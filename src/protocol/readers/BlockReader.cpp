#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <variant>

#include "base/Names.h"
#include "base/SimulationChoices.h"
#include "experiment/Rows.h"
#include "protocol/readers/ProtocolTables.h"
#include "tasks/Tasks.h"

namespace heft {

namespace {
struct NamesInUse {
  const TechniqueNames& techniques;
  UniqueNames blocks{"block"}, staircases{"staircase"};
};

Block read_demonstration(TableReader& table, NamesInUse&) {
  DemonstrationBlock block;
  table.read("name", block.name);
  table.read("duration_s", block.duration_s, above_zero);
  table.close();
  return block;
}

// trials = { soft = 5, hard = 5 }
std::vector<TechniqueTrials> read_trials_by_technique(TableReader& table, NamesInUse& names) {
  auto counts = table.table("trials");
  std::vector<TechniqueTrials> trials;
  for (const std::string& technique : counts->keys()) {
    int n = 0;
    counts->read(technique, n, {0, most_trials});
    names.techniques.check(*counts, technique, technique);
    trials.push_back({technique, n});
  }
  return trials;
}

// trials = 10, c1_trials = 5: the form before techniques had names
std::vector<TechniqueTrials> read_trials_of_two(TableReader& table) {
  int trials = 10, c1_trials = 5;
  table.require({"trials", "c1_trials"});
  table.read("trials", trials, {1, most_trials});
  table.read("c1_trials", c1_trials, {0, most_trials});
  if (table.good({"trials", "c1_trials"}) && c1_trials > trials)
    table.mistake("c1_trials",
                  fmt::format("c1_trials is {}, expected at most trials {}", c1_trials, trials));
  return {{coupled_technique, c1_trials}, {spring_technique, trials - c1_trials}};
}

// The block's reference is there, but could not be read: its mistake is reported.
bool has_wrong_object(const TableReader& block, const StaircaseRules& rules) {
  return rules.reference == StaircaseRules::Reference::required && !rules.object_g &&
         block.has("reference");
}

// catch_trials = { 15g = 10, 200g = 10 } by reference, or one number for all of them together.
void read_catch_trials(TableReader& table, Comparison::Block& block) {
  std::vector<double> references_g;
  for (const ReferenceStaircase& entry : block.staircases)
    if (std::ranges::count(references_g, entry.reference_g) == 0)
      references_g.push_back(entry.reference_g);
  if (auto counts = table.has_table("catch_trials") ? table.table("catch_trials") : std::nullopt) {
    if (has_wrong_object(table, block.staircase_rules())) return;
    for (const double reference_g : references_g) {
      int n = 0;
      counts->read(fmt::format("{:g}g", reference_g), n, {0, most_trials});
      if (n > 0) block.catch_trials.push_back({reference_g, n});
    }
    return counts->close();
  }
  int n = 0;
  table.read("catch_trials", n, {0, most_trials});
  const int n_references = std::max(1, static_cast<int>(references_g.size()));
  if (n % n_references != 0)
    table.mistake("catch_trials",
                  fmt::format("catch_trials is {} for {} references, expected a "
                              "multiple of {}, or a number for each: {{ \"{:g}g\" "
                              "= {} }}",
                              n, n_references, n_references, references_g[0], n / n_references));
  for (const double reference_g : references_g)
    if (n >= n_references) block.catch_trials.push_back({reference_g, n / n_references});
}

void read_catches(TableReader& table, Comparison::Block& block) {
  const bool has_number = table.has("catch_trials");
  if (table.has("catch_every") && !has_number)
    table.mistake("catch_every", "catch_every requires catch_trials, which it spreads");
  table.read("catch_every", block.catch_every, {4, most_trials});
  read_catch_trials(table, block);
}

// Reads a block's keys into its fields, by their types.
class KeyReader {
 public:
  KeyReader(TableReader& table, NamesInUse& names) : table_(table), names_(names) {}

  template <typename Field, typename... Ranges>
  void operator()(const ConfigKey& key, Field&& field, const Ranges&... range) {
    if (key.is_required) table_.require({key.name});
    read(key.name, field, range...);
  }

 private:
  template <typename Field, typename... Ranges>
  requires requires(TableReader table, Field& field, const Ranges&... range) {
    table.read("", field, range...);
  }
  void read(std::string_view key, Field& field, const Ranges&... range) {
    table_.read(key, field, range...);
  }
  template <typename Keys>
  requires requires(Keys keys, KeyReader reader) { keys.visit_keys(reader); }
  void read(std::string_view key, std::optional<Keys>& field) {
    auto inner = table_.table(key);
    if (!inner) return;
    Keys keys;
    KeyReader reader(*inner, names_);
    keys.visit_keys(reader);
    inner->close();
    bool is_good = true;
    keys.visit_keys(
        [&](const ConfigKey& its, const auto&...) { is_good &= inner->good({its.name}); });
    if (is_good) field = keys;
  }

  // responses = { yes = "positive", no = "negative" }
  void read(std::string_view key, Meanings& meanings) {
    auto table = table_.table(key);
    if (!table) return;
    for (const std::string& value : table->keys())
      if (const auto name = table->read_nearest_name(value, EnumNames<Meaning>::names))
        meanings.emplace_back(value, *named<Meaning>(*name));
    table->close();
  }
  void read(std::string_view, ByTechnique<std::string>& field) {
    names_.techniques.read(table_, field.name);
  }
  void read(std::string_view, std::vector<TechniqueTrials>& trials) {
    trials = table_.has_table("trials") ? read_trials_by_technique(table_, names_)
                                        : read_trials_of_two(table_);
  }
  void read(std::string_view, TrialsOfEach<std::vector<TechniqueTrials>>& field) {
    if (table_.has_table("trials")) {
      if (int unused = 0; field.number_key != "trials" && table_.has(field.number_key)) {
        table_.read(field.number_key, unused, {1, most_trials});
        table_.mistake(field.number_key, fmt::format("{} together with [block.trials], expected "
                                                     "only one of them",
                                                     field.number_key));
      }
      field.trials = read_trials_by_technique(table_, names_);
      return;
    }
    TechniqueTrials all{spring_technique, 1};
    table_.require({field.number_key});
    table_.read(field.number_key, all.trials, {1, most_trials});
    names_.techniques.read(table_, all.technique);
    field.trials = {all};
  }
  void read(std::string_view, InterleaveConfig& field) { field = read_interleaving(table_); }
  template <typename Block>
  void read(std::string_view key, StaircasesOf<Block>& field) {
    StaircaseRules rules = field.block.staircase_rules();
    if (has_wrong_object(table_, rules)) rules.reference = StaircaseRules::Reference::unknown;
    for (TableReader& staircase : table_.tables(key))
      std::ranges::move(read_staircases_of(staircase, names_.techniques, names_.staircases, rules),
                        std::back_inserter(field.block.staircases));
  }
  void read(std::string_view, CatchTrials<Comparison::Block>& field) {
    read_catches(table_, field.block);
  }

  TableReader& table_;
  NamesInUse& names_;
};

void check_practice(TableReader& table, const TaskBlock& block) {
  if (!block.practice) return;
  const Practice& practice = *block.practice;
  if (practice.needs_correctness() && !block.has_correct_answers())
    table.mistake("practice",
                  fmt::format("practice with feedback or until_correct, but answers of the task "
                              "{} are neither correct nor incorrect; expected trials alone",
                              block.task().name));
  if (practice.until_correct > practice.trials)
    table.mistake("practice", fmt::format("until_correct is {}, expected at most trials {}",
                                          practice.until_correct, practice.trials));
}

template <typename Kind>
Block read_trials(TableReader& table, NamesInUse& names) {
  typename Kind::Block block;
  std::optional<Practice> practice;
  table.read("name", block.name);
  KeyReader keys(table, names);
  block.visit_keys(keys);
  keys(ConfigKey{"practice", "before the trials"}, practice);
  table.close();
  table.note(block.check());
  TaskBlock trials(std::move(block));
  trials.practice = practice;
  check_practice(table, trials);
  return trials;
}

Block read_break(TableReader& table, NamesInUse&) {
  BreakBlock block;
  table.read("name", block.name);
  table.read("least_duration_s", block.least_duration_s, zero_or_more);
  table.close();
  return block;
}

struct BlockKind {
  std::string_view name;
  Block (*read)(TableReader& table, NamesInUse& names);
};

const std::vector<BlockKind>& block_kinds() {
  static const auto kinds = [] {
    std::vector<BlockKind> all{{"demonstration", read_demonstration}};
    Tasks::each([&]<typename Kind>() { all.push_back({Kind::task.name, read_trials<Kind>}); });
    all.push_back({"break", read_break});
    return all;
  }();
  return kinds;
}

// A misspelled kind is reported, and the block is checked as the most similar kind.
std::optional<Block> read_block(TableReader& table, NamesInUse& names) {
  const std::span<const BlockKind> kinds(block_kinds());
  const auto name = table.read_nearest_name("kind", names_in(kinds));
  if (!name) return std::nullopt;
  table.require({"name"});
  Block block = std::ranges::find(kinds, *name, &BlockKind::name)->read(table, names);
  names.blocks.check(table, block_name(block));
  return block;
}

// A break separates two blocks: it is neither first nor last, nor next to another break.
void check_breaks(std::vector<TableReader>& tables,
                  const std::vector<std::optional<Block>>& blocks) {
  const auto is_break = [&](std::size_t i) {
    return blocks[i] && std::holds_alternative<BreakBlock>(*blocks[i]);
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!is_break(i)) continue;
    if (i == 0 || i + 1 == blocks.size())
      tables[i].mistake("kind",
                        fmt::format("a break is the {} block, expected it between two others",
                                    i == 0 ? "first" : "last"));
    else if (is_break(i - 1))
      tables[i].mistake("kind", "a break follows a break, expected one longer break");
  }
}

// Positions of the named blocks in the file; a break stays between its blocks.
std::vector<std::size_t> places_of(TableReader& protocol, const std::vector<Block>& blocks,
                                   const std::vector<std::string>& order) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto found = std::ranges::find(blocks, order[i], block_name);
    const auto place = static_cast<std::size_t>(found - blocks.begin());
    if (found == blocks.end())
      protocol.mistake("block_order", i, fmt::format("there is no block \"{}\"", order[i]));
    else if (std::holds_alternative<BreakBlock>(*found))
      protocol.mistake("block_order", i,
                       fmt::format("\"{}\" is a break, which cannot be moved", order[i]));
    else if (std::ranges::count(places, place) > 0)
      protocol.mistake("block_order", i, fmt::format("\"{}\" is listed twice", order[i]));
    places.push_back(place);
  }
  return places;
}
}  // namespace

void read_block_order(TableReader& protocol, std::vector<Block>& blocks) {
  std::vector<std::string> order;
  protocol.read("block_order", order);
  if (order.empty() || !protocol.good({"block"})) return;
  const std::vector<std::size_t> wanted = places_of(protocol, blocks, order);
  if (!protocol.good({"block_order"})) return;
  std::vector<std::size_t> places = wanted;
  std::ranges::sort(places);
  const std::vector<Block> before = blocks;
  for (std::size_t i = 0; i < places.size(); ++i) blocks[places[i]] = before[wanted[i]];
}

std::vector<Block> read_blocks(TableReader& protocol, const TechniqueNames& techniques) {
  NamesInUse names{techniques};
  std::vector<TableReader> tables = protocol.tables("block");
  std::vector<std::optional<Block>> read;
  for (TableReader& table : tables) read.push_back(read_block(table, names));
  check_breaks(tables, read);
  std::vector<Block> blocks;
  for (auto& block : read)
    if (block) blocks.push_back(std::move(*block));
  return blocks;
}

}  // namespace heft
