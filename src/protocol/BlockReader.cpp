#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "base/DefaultTechniques.h"
#include "experiment/Rows.h"
#include "protocol/ProcedureReader.h"
#include "protocol/ProtocolTables.h"

namespace heft {

namespace {
constexpr Range catch_fractions{0, 1, false, true};

struct NamesInUse {
  const TechniqueNames& techniques;
  UniqueNames blocks{"block"}, staircases{"staircase"};
};

// A task whose cubes weigh the same has no right answer.
void read_masses(TableReader& table, std::vector<double>& masses_g, std::size_t fewest,
                 std::size_t most) {
  table.require({"masses_g"});
  table.read("masses_g", masses_g, above_zero);
  if (!table.has("masses_g") || !table.good({"masses_g"})) return;
  if (masses_g.size() < fewest || masses_g.size() > most)
    table.mistake("masses_g",
                  fmt::format("masses_g has {} masses, expected {}: one a cube", masses_g.size(),
                              fewest == most ? fmt::format("{}", most)
                                             : fmt::format("{} to {}", fewest, most)));
  for (std::size_t i = 0; i < masses_g.size(); ++i)
    if (std::ranges::count(std::span(masses_g).first(i), masses_g[i]) > 0)
      table.mistake("masses_g", i,
                    fmt::format("masses_g has {} g twice, expected different masses: equal ones "
                                "have no right answer",
                                masses_g[i]));
}

Block read_demonstration(TableReader& table, NamesInUse&) {
  DemonstrationBlock block;
  table.read("name", block.name);
  table.read("duration_s", block.duration_s, above_zero);
  table.close();
  return block;
}

Block read_introduction(TableReader& table, NamesInUse& names) {
  IntroductionBlock block;
  table.read("name", block.name);
  read_masses(table, block.masses_g, 2, 2);
  names.techniques.read(table, block.condition);
  table.read("wrong_answer", block.wrong_answer);
  table.close();
  return block;
}

constexpr int most_trials = 500;  // beyond any session, and what drawing their order takes

// trials = { C1 = 5, C2 = 5 }
void read_trials_by_technique(TableReader& table, SortingBlock& block, NamesInUse& names) {
  auto counts = table.table("trials");
  block.trials.clear();
  for (const std::string& technique : counts->keys()) {
    int n = 0;
    counts->read(technique, n, {0, most_trials});
    names.techniques.check(*counts, technique, technique);
    block.trials.push_back({technique, n});
  }
  if (block.n_trials() < 1 || block.n_trials() > most_trials)
    table.mistake("trials", fmt::format("trials are {} in all, expected 1 to {}", block.n_trials(),
                                        most_trials));
}

// trials = 10, c1_trials = 5: as it was written before techniques had names
void read_trials_of_two(TableReader& table, SortingBlock& block) {
  int trials = 10, c1_trials = 5;
  table.require({"trials", "c1_trials"});
  table.read("trials", trials, {1, most_trials});
  table.read("c1_trials", c1_trials, {0, most_trials});
  if (table.good({"trials", "c1_trials"}) && c1_trials > trials)
    table.mistake("c1_trials",
                  fmt::format("c1_trials is {}, expected at most trials {}", c1_trials, trials));
  block.trials = {{coupled_technique, c1_trials}, {spring_technique, trials - c1_trials}};
}

// Runs of one technique are shortest when the others' trials part those of the commonest.
void check_longest_run(TableReader& table, const SortingBlock& block) {
  if (!table.good({"trials", "c1_trials", "max_run"}) || block.max_run == 0) return;
  int commonest = 0;
  for (const TechniqueTrials& some : block.trials) commonest = std::max(commonest, some.trials);
  const int others = block.n_trials() - commonest;
  const int shortest = (commonest + others) / (others + 1);
  if (block.max_run < shortest)
    table.mistake(
        "max_run",
        fmt::format("max_run is {}, but {} trials of one technique and {} of others can't "
                    "be ordered without a longer run, expected at least {}, or 0 for any",
                    block.max_run, commonest, others, shortest));
}

Block read_sorting(TableReader& table, NamesInUse& names) {
  SortingBlock block;
  table.read("name", block.name);
  read_masses(table, block.masses_g, 2, FrameRow::most_cubes);
  if (table.has_table("trials"))
    read_trials_by_technique(table, block, names);
  else
    read_trials_of_two(table, block);
  table.read("max_run", block.max_run);
  table.read("orders", block.orders);
  table.close();
  check_longest_run(table, block);
  return block;
}

// paired = true: one staircase from `start`, one from `start_below`, otherwise alike.
std::vector<StaircaseSettings> pair_of(TableReader& table, const StaircaseSettings& read,
                                       std::optional<double> start_below) {
  const auto* above = std::get_if<UpDownConfig>(&read.config);
  if (!above) {
    table.mistake("paired", "paired is for up_down staircases, which have a start to pair");
    return {};
  }
  UpDownConfig below = *above;
  if (start_below)
    below.start = *start_below;
  else if (above->floor)
    below.start = *above->floor;
  if (table.good({"start", "start_below", "floor"}) &&
      (below.start >= above->start || (above->floor && below.start < *above->floor)))
    table.mistake(start_below ? "start_below" : "paired",
                  fmt::format("the staircase from below starts at {}, expected below the start {} "
                              "and not below the floor: say start_below",
                              below.start, above->start));
  return {{read.name + " from above", *above}, {read.name + " from below", below}};
}

std::vector<ReferenceStaircase> read_reference_staircases(TableReader& table, NamesInUse& names) {
  double reference_g = 0;
  std::string condition;
  bool paired = false;
  std::optional<double> start_below;
  table.require({"reference_g"});
  table.read("reference_g", reference_g, above_zero);
  names.techniques.read(table, condition);
  table.read("paired", paired);
  table.read("start_below", start_below, zero_or_more);
  if (start_below && !paired)
    table.mistake("start_below",
                  "start_below without paired = true, which makes a second "
                  "staircase that starts there");
  const auto settings = read_staircase(table);
  if (!settings) return {};
  if (table.has("reference_g") && table.good({"reference_g"}))
    check_beside(table, *settings, reference_g);
  std::vector<ReferenceStaircase> staircases;
  for (const StaircaseSettings& one :
       paired ? pair_of(table, *settings, start_below) : std::vector{*settings}) {
    names.staircases.check(table, one.name);
    staircases.push_back({reference_g, one.procedure(), condition});
  }
  return staircases;
}

// catch_trials = { 15g = 10, 200g = 10 } by reference, or a number for all of them together.
void read_catch_trials(TableReader& table, ComparisonBlock& block) {
  std::vector<double> references_g;
  for (const ReferenceStaircase& entry : block.staircases)
    if (std::ranges::count(references_g, entry.reference_g) == 0)
      references_g.push_back(entry.reference_g);
  if (auto counts = table.has_table("catch_trials") ? table.table("catch_trials") : std::nullopt) {
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

void read_catches(TableReader& table, ComparisonBlock& block) {
  table.read("catch_fraction", block.catch_fraction, catch_fractions);
  const bool has_number = table.has("catch_trials");
  if (has_number && block.catch_fraction > 0)
    table.mistake("catch_fraction",
                  "catch_fraction together with catch_trials, expected one of "
                  "them: a coin each trial, or a fixed number");
  if (table.has("catch_every") && !has_number)
    table.mistake("catch_every", "catch_every without catch_trials, which it spreads");
  table.read("catch_every", block.catch_every, {4, most_trials});
  read_catch_trials(table, block);
}

Block read_comparison(TableReader& table, NamesInUse& names) {
  ComparisonBlock block;
  table.require({"staircase"});
  table.read("name", block.name);
  names.techniques.read(table, block.condition);
  table.read("positive_answer", block.positive_answer);
  table.read("sides", block.sides);
  block.interleaving = read_interleaving(table);
  for (TableReader& staircase : table.tables("staircase"))
    std::ranges::move(read_reference_staircases(staircase, names),
                      std::back_inserter(block.staircases));
  read_catches(table, block);
  table.close();
  return block;
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
constexpr std::array kinds{
    BlockKind{"demonstration", read_demonstration}, BlockKind{"introduction", read_introduction},
    BlockKind{"sorting", read_sorting}, BlockKind{"comparison", read_comparison},
    BlockKind{"break", read_break}};

// A misspelled kind is noted, and the block is checked as what it was most likely meant to be.
std::optional<Block> read_block(TableReader& table, NamesInUse& names) {
  std::array<std::string_view, kinds.size()> kind_names;
  std::ranges::transform(kinds, kind_names.begin(), &BlockKind::name);
  const auto name = table.read_nearest_name("kind", kind_names);
  if (!name) return std::nullopt;
  table.require({"name"});
  Block block = std::ranges::find(kinds, *name, &BlockKind::name)->read(table, names);
  std::visit([&](const auto& read) { names.blocks.check(table, read.name); }, block);
  return block;
}

// A break parts two blocks: it is neither first nor last, and no other break is beside it.
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

// The place of each named block in the file; a break stays between the blocks that it parts.
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
                       fmt::format("\"{}\" is a break, which stays where it is", order[i]));
    else if (std::ranges::count(places, place) > 0)
      protocol.mistake("block_order", i, fmt::format("\"{}\" is there twice", order[i]));
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
