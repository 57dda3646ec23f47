#include <fmt/format.h>

#include <algorithm>

#include "base/Pose.h"
#include "base/SimulationChoices.h"
#include "base/files/TextFile.h"
#include "base/math/Geometry.h"
#include "physics/scene/Scene.h"
#include "protocol/readers/Files.h"
#include "protocol/readers/ProtocolTables.h"

namespace heft {

namespace {
constexpr double tolerance_m =
    1e-6;  ///< rounding in a hand-written file, far below any contact distance

struct PlacedCube {
  Cube cube;
  TableReader table;
};

PlacedCube read_cube(TableReader table) {
  Cube cube;
  table.require({"mass_kg", "size_m", "position_m"});
  table.read("mass_kg", cube.mass_kg, above_zero);
  table.read_size("size_m", cube.size_m);
  table.read("position_m", cube.position_m, on_earth);
  table.read("yaw_rad", cube.yaw_rad);
  table.read("table_friction", cube.table_friction, zero_or_more);
  table.close();
  return {cube, std::move(table)};
}

void check_above_table(PlacedCube& placed) {
  if (!placed.table.good({"size_m", "position_m"})) return;
  const double bottom_m = placed.cube.position_m.z() - placed.cube.size_m.z() / 2;
  if (bottom_m < -tolerance_m)
    placed.table.mistake(
        "position_m", 2,
        fmt::format("position_m puts the cube {:.6g} m into the table, expected its center at "
                    "least half its height ({:.6g} m) above z = 0",
                    -bottom_m, placed.cube.size_m.z() / 2));
}

bool overlap(const Cube& a, const Cube& b) {
  const Eigen::Vector3d shrunk_m = a.size_m.array() - tolerance_m;
  return boxes_overlap(upright_pose(a.position_m, a.yaw_rad), shrunk_m,
                       upright_pose(b.position_m, b.yaw_rad), b.size_m);
}

void check_overlaps(std::vector<PlacedCube>& cubes) {
  const auto known = [](const PlacedCube& cube) {
    return cube.table.good({"size_m", "position_m", "yaw_rad"});
  };
  for (std::size_t i = 0; i < cubes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (known(cubes[i]) && known(cubes[j]) && overlap(cubes[i].cube, cubes[j].cube))
        cubes[i].table.mistake(
            "position_m", fmt::format("cube {} overlaps cube {} (line {}), expected them apart",
                                      i + 1, j + 1, cubes[j].table.place().line));
}

std::vector<Cube> read_cubes(TableReader& reader) {
  std::vector<PlacedCube> placed;
  for (TableReader& table : reader.tables("cube")) placed.push_back(read_cube(std::move(table)));
  std::ranges::for_each(placed, check_above_table);
  check_overlaps(placed);
  std::vector<Cube> cubes;
  for (const PlacedCube& cube : placed) cubes.push_back(cube.cube);
  return cubes;
}

Pose read_clone_offset(TableReader& reader) {
  Pose offset;
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  reader.in_table("clone", [&](TableReader& table) {
    table.read("offset_m", offset.position_m, on_earth);
    table.read("offset_rotvec_rad", rotation_rad);
  });
  offset.orientation = rotation_from_vector(rotation_rad);
  return offset;
}

// [coupling], the paper's technique by default, with `condition` for another; or [[technique]]s and
// the selected one.
void read_scene_technique(TableReader& reader, Scene& scene) {
  Coupling defaults;
  auto table = reader.table("coupling");
  if (table) defaults = read_coupling(*table);
  const std::vector<Technique> declared = read_techniques(reader, defaults);
  const TechniqueNames names(declared);
  std::string technique = declared.empty() ? spring_technique : declared.front().name;
  if (table) {
    names.read(*table, technique);
    table->close();
  }
  technique_named(technique, declared, defaults).apply_to(scene);
}
}  // namespace

Scene parse_scene(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  Scene scene;
  reader.read("friction", scene.friction, zero_or_more);
  reader.read("gravity_m_s2", scene.gravity_m_s2, zero_or_more);
  reader.read("contact_compliance_m_per_n", scene.contact_compliance_m_per_n, compliances);
  read_effector(reader, scene.effector_size_m);
  read_scene_technique(reader, scene);
  scene.clone_offset = read_clone_offset(reader);
  scene.cubes = read_cubes(reader);
  reader.in_table("tolerance", [&](TableReader& table) {
    table.read("clone_rms_m", scene.tolerance.clone_rms_m, above_zero);
    table.read("lag_g", scene.tolerance.lag_g, above_zero);
    table.read("cubes_rms_m", scene.tolerance.cubes_rms_m, above_zero);
    table.read("turn_rms_rad", scene.tolerance.turn_rms_rad, above_zero);
  });
  reader.close();
  mistakes.throw_if_any();
  return scene;
}

Scene load_scene(const std::string& path) {
  return parse_scene(read_text_file(path), path);
}

}  // namespace heft
