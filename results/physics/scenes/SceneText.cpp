// Scenes and paths in the file formats of `heft scene`. Numbers have the fewest digits that read
// back as the same doubles.
#include <fmt/format.h>

#include <sstream>

#include "base/Pose.h"
#include "base/SimulationChoices.h"
#include "results/physics/scenes/Scenes.h"

namespace heft {

namespace {
// As comment lines of at most 100 characters.
std::string comment(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line = "#", word;
  while (words >> word) {
    if (line.size() + 1 + word.size() > 100) {
      lines += line + '\n';
      line.assign(1, '#');
    }
    line += ' ' + word;
  }
  return lines + line + '\n';
}

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

std::string coupling_text(const Coupling& coupling) {
  return fmt::format(
      "\n[coupling]\ncondition = \"{}\"\nstiffness_n_per_m = {}\ntorsional_stiffness_nm_per_rad = "
      "{}\nclone_mass_kg = {}\ndamping_ratio = {}\n",
      default_technique(coupling.decoupled), coupling.stiffness_n_per_m,
      coupling.torsional_stiffness_nm_per_rad, coupling.clone_mass_kg, coupling.damping_ratio);
}

std::string clone_text(const Pose& offset) {
  const Eigen::Vector3d turn_rad = rotation_vector(offset.orientation);
  if (offset.position_m.isZero(0) && turn_rad.isZero(0)) return "";
  return fmt::format("\n[clone]\noffset_m = {}\noffset_rotvec_rad = {}\n",
                     vector_text(offset.position_m), vector_text(turn_rad));
}

std::string cube_text(const Cube& cube) {
  return fmt::format("\n[[cube]]\nmass_kg = {}\nsize_m = {}\nposition_m = {}\nyaw_rad = {}\n",
                     cube.mass_kg, cube.size_m.x(), vector_text(cube.position_m), cube.yaw_rad) +
         (cube.table_friction ? fmt::format("table_friction = {}\n", *cube.table_friction) : "");
}

std::string row_text(const TrajectoryRow& row) {
  if (!row.pose) return fmt::format("{},,,,,,,\n", row.t_s);
  const auto& p = row.pose->position_m;
  const auto& q = row.pose->orientation;
  return fmt::format("{},{},{},{},{},{},{},{}\n", row.t_s, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                     q.z());
}
}  // namespace

std::string scene_toml(const BenchScene& scene) {
  std::string text = comment(scene.about);
  text += fmt::format("friction = {}\n", scene.scene.friction);
  if (scene.scene.contact_compliance_m_per_n > 0)
    text +=
        fmt::format("contact_compliance_m_per_n = {}\n", scene.scene.contact_compliance_m_per_n);
  text += coupling_text(scene.scene.coupling) + clone_text(scene.scene.clone_offset);
  for (const Cube& cube : scene.scene.cubes) text += cube_text(cube);
  return text;
}

std::string path_csv(const BenchScene& scene) {
  std::string text = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n";
  for (const TrajectoryRow& row : scene.path) text += row_text(row);
  return text;
}

}  // namespace heft
