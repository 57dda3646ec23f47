#include "protocol/Protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/Names.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/readers/ProtocolTables.h"
#include "tasks/Comparison.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {
constexpr Range display_rates_hz{1, 1000};
constexpr Range physics_rates_hz{1, 100000};
constexpr Range predictions_s{0, 0.2};  // longer predictions of a hand are useless
constexpr Range onsets_s{0, 60};
constexpr Range text_sizes{least_text_size, most_text_size};
constexpr Range fractions{0, 1};
constexpr Range margins_percent{least, 50};

void read_physics(TableReader& reader, Protocol& protocol) {
  reader.in_table("physics", [&](TableReader& table) {
    table.read("friction", protocol.friction, zero_or_more);
    table.read("friction_is", protocol.friction_is);
    table.read("contact_compliance_m_per_n", protocol.contact_compliance_m_per_n, compliances);
    table.read("gravity_m_s2", protocol.gravity_m_s2, zero_or_more);
    SimulatorChoice& simulator = protocol.simulator;
    simulator.name = table.read_name("simulator", names_in(simulators())).value_or(simulator.name);
    table.read("rate_hz", simulator.rate_hz, physics_rates_hz);
    table.read("input", simulator.input.mode);
    table.read("predict_s", simulator.input.predict_s, predictions_s);
  });
}

void read_onset(TableReader& reader, Onset& onset) {
  reader.in_table("onset", [&](TableReader& table) {
    table.read("gap_s", onset.gap_s, onsets_s);
    table.read("min_answer_s", onset.min_answer_s, onsets_s);
  });
}

// The name is part of a file's name and of the log's keys, where a point follows it.
bool is_plain_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

// A questionnaire has one place in the log for its answers after a block.
void read_asked(TableReader& table, ScreensChosen& screens) {
  std::string name, after;
  table.require({"name"});
  table.read("name", name);
  table.read("after", after);
  table.close();
  std::vector<std::string>& there = screens.questionnaires[after];
  if (table.has("name") && table.good({"name"}) && !is_plain_name(name))
    table.mistake("name", fmt::format("name is \"{}\", expected letters, digits, _ and - only",
                                      printable(name)));
  else if (std::ranges::count(there, name) > 0)
    table.mistake("name",
                  fmt::format("\"{}\" is already asked {}, expected each questionnaire once there",
                              printable(name), after.empty() ? "at the end" : "after that block"));
  there.push_back(name);
}

// A misspelled block would silently drop the questionnaire.
void check_asked(TableReader& reader, const Protocol& protocol) {
  std::set<std::string> blocks{""};
  for (const Block& block : protocol.blocks) blocks.insert(block_name(block));
  for (const auto& [after, names] : protocol.screens.questionnaires)
    if (!blocks.contains(after) && reader.good({"screens", "block"}))
      reader.mistake(
          "screens",
          fmt::format("a questionnaire comes after \"{}\", but there is no block of that name, "
                      "expected a block's name, or none for the end",
                      printable(after)));
}

void read_screens(TableReader& reader, ScreensChosen& screens) {
  reader.in_table("screens", [&](TableReader& table) {
    table.read("language", screens.language);
    table.read("consent", screens.consent);
    table.read("about_you", screens.about_you);
    table.read("how_decided", screens.how_decided);
    table.read("crop", screens.crop);
    table.read("text_size", screens.text_size, text_sizes);
    table.read("patch", screens.patch);
    for (TableReader& one : table.tables("questionnaire")) read_asked(one, screens);
  });
}

// The largest number of cubes in a block.
int most_cubes(const std::vector<Block>& blocks) {
  int most = 2;
  for (const Block& block : blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block))
      most = std::max(most, trials->most_cubes());
  return most;
}

void check_fit(TableReader& table, const Layout& layout, int n_cubes) {
  if (!table.good({"cube_size_m", "gap_m", "row_y_m", "area_m"})) return;
  const std::string_view key = table.has("area_m") ? "area_m" : "cube_size_m";
  const double width_m = n_cubes * layout.cube_size_m + (n_cubes - 1) * layout.gap_m;
  if (width_m > layout.area_m.x())
    table.mistake(key,
                  fmt::format("a row of {} cubes is {:.6g} m wide, but the area only {:.6g} m, "
                              "expected a wider area, smaller cubes or a smaller gap_m",
                              n_cubes, width_m, layout.area_m.x()));
  const double reach_m = std::abs(layout.row_y_m) + layout.cube_size_m / 2;
  if (reach_m > layout.area_m.y() / 2)
    table.mistake(key,
                  fmt::format("cubes at row_y_m {:.6g} reach {:.6g} m from the middle, but the "
                              "area only {:.6g} m, expected a deeper area or a nearer row",
                              layout.row_y_m, reach_m, layout.area_m.y() / 2));
}

void read_layout(TableReader& reader, Layout& layout, int n_cubes) {
  auto table = reader.table("layout");
  if (!table) return;
  table->read("cube_size_m", layout.cube_size_m, above_zero);
  table->read("gap_m", layout.gap_m, zero_or_more);
  table->read("row_y_m", layout.row_y_m);
  table->read("start_distance_m", layout.start_distance_m, zero_or_more);
  table->read("area_m", layout.area_m, above_zero);
  table->read("out_of_area", layout.out_of_area);
  table->read("clear_m", layout.clear_m, zero_or_more);
  table->close();
  check_fit(*table, layout, n_cubes);
  if (table->good({"start_distance_m", "clear_m"}) && layout.start_distance_m < layout.clear_m)
    table->mistake(
        table->has("start_distance_m") ? "start_distance_m" : "clear_m",
        fmt::format("start_distance_m {:.6g} is less than clear_m {:.6g}: the cubes of a "
                    "resting effector would never appear, expected at least as much",
                    layout.start_distance_m, layout.clear_m));
}

void read_analysis(TableReader& protocol, AnalysisPlan& plan) {
  protocol.in_table("analysis", [&](TableReader& table) {
    for (std::size_t i = 0; i < hypothesis_names.size(); ++i)
      table.read(hypothesis_names.at(i), plan.tested.at(i));
    table.read("equivalence_margin", plan.equivalence_margin, margins_percent);
  });
}

void read_exclusion(TableReader& protocol, ExclusionRules& rules) {
  protocol.in_table("exclusion", [&](TableReader& table) {
    table.read("unfinished", rules.unfinished);
    // Protocols in logs may have the former name.
    table.read("impossible_answers", rules.anticipatory_responses, fractions);
    table.read("anticipatory_responses", rules.anticipatory_responses, fractions);
    table.read("false_alarms", rules.false_alarms, fractions);
    table.read("out_of_view", rules.out_of_view, fractions);
  });
}

// Results are by reference and technique: a cube and a real object would be mixed.
void check_references(TableReader& protocol, const std::vector<Block>& blocks) {
  std::map<std::pair<double, std::string>, const Comparison::Block*> first;
  for (const Block& block : blocks) {
    const auto* comparison = block_as<Comparison::Block>(block);
    if (!comparison) continue;
    for (const ReferenceStaircase& one : comparison->staircases) {
      const std::string& technique = one.condition.empty() ? comparison->condition : one.condition;
      const auto [found, is_new] = first.try_emplace({one.reference_g, technique}, comparison);
      if (is_new || found->second->reference.has_value() == comparison->reference.has_value())
        continue;
      return protocol.mistake(
          "block", fmt::format("the reference of {:g} g in {} is a cube and, in another block ({} "
                               "and {}), a real object; expected another mass, or another name "
                               "for the technique",
                               one.reference_g, technique, found->second->name, comparison->name));
    }
  }
}
}  // namespace

bool AnalysisPlan::declares(std::string_view hypothesis) const {
  const auto found = std::ranges::find(hypothesis_names, hypothesis);
  return found != hypothesis_names.end() &&
         tested.at(static_cast<std::size_t>(found - hypothesis_names.begin()));
}

bool AnalysisPlan::declares_any() const {
  return std::ranges::count(tested, true) > 0;
}

Protocol parse_protocol(const std::string& text, const std::string& file,
                        std::span<const ProtocolSetting> settings) {
  Mistakes mistakes(file);
  TomlTable root = parse_toml(text, file);
  apply_settings(root, settings);
  TableReader reader(root, mistakes);
  Protocol protocol;
  protocol.text = text;
  protocol.sha256 = sha256(text);
  reader.require({"title", "block"});
  reader.read("title", protocol.title);
  reader.read("display_rate_hz", protocol.display_rate_hz, display_rates_hz);
  reader.read("void_after_s", protocol.void_after_s, above_zero);
  reader.read("require_contact", protocol.require_contact);
  read_effector(reader, protocol.effector_size_m);
  read_physics(reader, protocol);
  const double rate_hz = protocol.simulator.rate_hz;
  reader.in_table("coupling",
                  [&](auto& table) { protocol.coupling = read_coupling(table, {}, rate_hz); });
  protocol.techniques = read_techniques(reader, protocol.coupling, rate_hz);
  read_onset(reader, protocol.onset);
  read_screens(reader, protocol.screens);
  read_analysis(reader, protocol.analysis);
  read_exclusion(reader, protocol.exclusion);
  protocol.blocks = read_blocks(reader, TechniqueNames(protocol.techniques));
  check_references(reader, protocol.blocks);
  read_block_order(reader, protocol.blocks);
  check_asked(reader, protocol);
  read_layout(reader, protocol.layout, most_cubes(protocol.blocks));
  reader.close();
  mistakes.throw_if_any();
  return protocol;
}

std::set<std::string> questionnaires_of(const Protocol& protocol) {
  std::set<std::string> all;
  for (const auto& [after, names] : protocol.screens.questionnaires)
    all.insert(names.begin(), names.end());
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block))
      if (const auto name = trials->questionnaire()) all.insert(*name);
  return all;
}

std::vector<Eigen::Vector3d> slot_positions(const Layout& layout, int n) {
  const double pitch_m = layout.cube_size_m + layout.gap_m;
  std::vector<Eigen::Vector3d> centers_m;
  for (int i = 0; i < n; ++i)
    centers_m.emplace_back((i - (n - 1) / 2.0) * pitch_m, layout.row_y_m, layout.cube_size_m / 2);
  return centers_m;
}

Stage stage_of(const Protocol& protocol, int n) {
  const Layout& layout = protocol.layout;
  return {protocol.effector_size_m, layout.cube_size_m, slot_positions(layout, n),
          layout.start_distance_m, protocol.display_rate_hz};
}

Scene scene_of(const Protocol& protocol, const std::string& technique,
               const std::vector<double>& masses_g, const std::vector<double>& table_friction) {
  Scene scene;
  scene.gravity_m_s2 = protocol.gravity_m_s2;
  scene.friction = protocol.friction_is == FrictionIs::per_body
                       ? protocol.friction * protocol.friction
                       : protocol.friction;
  scene.contact_compliance_m_per_n = protocol.contact_compliance_m_per_n;
  scene.effector_size_m = protocol.effector_size_m;
  technique_named(technique, protocol.techniques, protocol.coupling).apply_to(scene);
  const double size_m = protocol.layout.cube_size_m;
  const auto slots_m = slot_positions(protocol.layout, static_cast<int>(masses_g.size()));
  for (std::size_t i = 0; i < masses_g.size(); ++i)
    scene.cubes.push_back({masses_g[i] / 1000, Eigen::Vector3d::Constant(size_m), slots_m[i], 0});
  for (std::size_t i = 0; i < table_friction.size(); ++i)
    scene.cubes.at(i).table_friction = table_friction[i];
  return scene;
}

Protocol load_protocol(const std::string& path, std::span<const ProtocolSetting> settings) {
  Protocol protocol = parse_protocol(read_text_file(path), path, settings);
  protocol.name = std::filesystem::path(path).stem().string();
  return protocol;
}

TrialsByTask expected_trials(const Protocol& protocol) {
  TrialsByTask trials;
  for (const Block& block : protocol.blocks)
    if (const auto* of_task = std::get_if<TaskBlock>(&block))
      trials[std::string(of_task->task().name)] += of_task->expected_trials();
  return trials;
}

double total_of(const TrialsByTask& trials) {
  double total = 0;
  for (const auto& [task, n] : trials) total += n;
  return total;
}

bool depends_on_answers(const Protocol& protocol) {
  return std::ranges::any_of(protocol.blocks, [](const Block& block) {
    const auto* of_task = std::get_if<TaskBlock>(&block);
    return of_task && of_task->depends_on_answers();
  });
}

double assumed_trial_s(const Protocol& protocol, std::string_view task) {
  double n = 0, seconds = 0;
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block);
        trials && trials->task().name == task) {
      n += trials->expected_trials();
      seconds += trials->expected_trials() * trials->trial_s();
    }
  return n > 0 ? seconds / n : task_named(task).trial_s;
}

double expected_minutes(const Protocol& protocol, const TrialsByTask& trials) {
  double seconds = 0;
  for (const Block& block : protocol.blocks) {
    if (const auto* shown = std::get_if<DemonstrationBlock>(&block)) seconds += shown->duration_s;
    if (const auto* pause = std::get_if<BreakBlock>(&block)) seconds += pause->least_duration_s;
  }
  for (const auto& [task, n] : trials)
    seconds += n * (assumed_trial_s(protocol, task) + protocol.onset.gap_s);
  return seconds / 60;
}

}  // namespace heft
