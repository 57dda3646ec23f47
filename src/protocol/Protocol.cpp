#include "protocol/Protocol.h"

#include <filesystem>

#include "base/TextFile.h"

namespace heft {

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
               const std::vector<double>& masses_g) {
  Scene scene;
  scene.gravity_m_s2 = protocol.gravity_m_s2;
  scene.friction = protocol.friction_is == FrictionIs::per_body
                       ? protocol.friction * protocol.friction
                       : protocol.friction;
  scene.effector_size_m = protocol.effector_size_m;
  technique_named(technique, protocol.techniques, protocol.coupling).apply_to(scene);
  const double size_m = protocol.layout.cube_size_m;
  const auto slots_m = slot_positions(protocol.layout, static_cast<int>(masses_g.size()));
  for (std::size_t i = 0; i < masses_g.size(); ++i)
    scene.cubes.push_back({masses_g[i] / 1000, Eigen::Vector3d::Constant(size_m), slots_m[i], 0});
  return scene;
}

Protocol load_protocol(const std::string& path, const std::vector<std::string>& settings) {
  Protocol protocol = parse_protocol(read_text_file(path), path, settings);
  protocol.name = std::filesystem::path(path).stem().string();
  return protocol;
}

}  // namespace heft
