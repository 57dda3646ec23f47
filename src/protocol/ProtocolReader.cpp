// parse_protocol: the top level of a protocol and its tables but [[block]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Sha256.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/BlockReader.h"
#include "protocol/PhysicsReader.h"
#include "protocol/Protocol.h"
#include "protocol/Settings.h"
#include "protocol/TechniqueReader.h"

namespace heft {

namespace {
constexpr Range display_rates_hz{1, 1000};
constexpr Range physics_rates_hz{1, 100000};
constexpr Range predictions_s{0, 0.2};  // beyond it no hand goes on as it did

void read_physics(TableReader& reader, Protocol& protocol) {
  auto table = reader.table("physics");
  if (!table) return;
  std::vector<std::string_view> names;
  for (const SimulatorEntry& entry : simulators()) names.push_back(entry.name);
  table->read("friction", protocol.friction, zero_or_more);
  table->read("friction_is", protocol.friction_is);
  table->read("gravity_m_s2", protocol.gravity_m_s2, zero_or_more);
  if (const auto name = table->read_name("simulator", names)) protocol.simulator.name = *name;
  table->read("rate_hz", protocol.simulator.rate_hz, physics_rates_hz);
  table->read("input", protocol.simulator.input.mode);
  table->read("predict_s", protocol.simulator.input.predict_s, predictions_s);
  table->close();
}

void read_screens(TableReader& reader, ScreensChosen& screens) {
  auto table = reader.table("screens");
  if (!table) return;
  table->read("language", screens.language);
  table->read("consent", screens.consent);
  table->read("about_you", screens.about_you);
  table->read("how_decided", screens.how_decided);
  table->close();
}

// How many cubes the block with most of them shows.
int most_cubes(const std::vector<Block>& blocks) {
  std::size_t most = 2;
  for (const Block& block : blocks)
    if (const auto* sorting = std::get_if<SortingBlock>(&block))
      most = std::max(most, sorting->masses_g.size());
  return static_cast<int>(most);
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
}  // namespace

Protocol parse_protocol(const std::string& text, const std::string& file,
                        const std::vector<std::string>& settings) {
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
  if (auto table = reader.table("coupling")) {
    protocol.coupling = read_coupling(*table);
    table->close();
  }
  protocol.techniques = read_techniques(reader, protocol.coupling);
  read_physics(reader, protocol);
  read_screens(reader, protocol.screens);
  protocol.blocks = read_blocks(reader, TechniqueNames(protocol.techniques));
  read_layout(reader, protocol.layout, most_cubes(protocol.blocks));
  reader.close();
  mistakes.throw_if_any();
  return protocol;
}

}  // namespace heft
