#include "session/Equipment.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "protocol/readers/Files.h"
#include "responders/hand/Hand.h"
#include "session/DisplayCheck.h"

namespace heft {

namespace {
constexpr double same_size_m = 0.0015;  // 1 % printing error, measured and recorded

bool has_size(const MarkerBody& effector, const Eigen::Vector3d& size_m) {
  return (effector.size_m - size_m).cwiseAbs().maxCoeff() < same_size_m;
}

// The simulated effector must have the size of the real one.
void require_size(const SessionConfig& config, const Protocol& protocol,
                  const MarkerBody& effector) {
  const Eigen::Vector3d& size_m = protocol.effector_size_m;
  if (has_size(effector, size_m)) return;
  throw Error(fmt::format("{} is {:.4g} x {:.4g} x {:.4g} m, but the protocol's [effector] size_m "
                          "is [{:.4g}, {:.4g}, {:.4g}]; make them the same",
                          config.effector.path, effector.size_m.x(), effector.size_m.y(),
                          effector.size_m.z(), size_m.x(), size_m.y(), size_m.z()),
              ExitCode::invalid_file);
}

// Board and effector that are filmed, else those of the files that exist. The effector's print must
// have the protocol's size.
Apparatus demonstrated_apparatus(const ResolvedConfig& resolved) {
  const auto& [path, text, hash] = resolved->config.board;
  if (resolved->tracker->has_camera) return resolved->apparatus;
  if (text.empty()) return {};
  const ConfigFile& effector = resolved->config.effector;
  Apparatus apparatus{{}, parse_board(text, path), parse_effector(effector.text, effector.path)};
  if (!has_size(apparatus.effector, resolved->protocol->effector_size_m)) {
    apparatus.effector = {};
    apparatus.effector.size_m = resolved->protocol->effector_size_m;
  }
  return apparatus;
}

// Starts where a model's hand would rest; none if the effector is not dragged.
std::shared_ptr<DraggedEffector> dragged_effector(const ResolvedConfig& resolved) {
  constexpr double hover_m = 0.005;
  if (!resolved->tracker->is_dragged) return {};
  return std::make_shared<DraggedEffector>(
      DraggedEffector{resting_pose(stage_of(*resolved->protocol, 3), hover_m)});
}

ViewSetup view_setup(const ResolvedConfig& resolved) {
  const Protocol& protocol = *resolved->protocol;
  const SessionConfig& config = resolved->config;
  ViewSetup setup;
  setup.stage = stage_of(protocol, 3);
  if (resolved->tracker->has_camera) setup.camera = resolved->apparatus.camera;
  setup.texts = resolved->texts;
  setup.left_handed = config.controls == Side::left;
  setup.takes_keys = config.keys == TakesKeys::yes;
  setup.text_size = protocol.screens.text_size;
  setup.patch = protocol.screens.patch;
  setup.file = resolved->film;
  setup.rate_hz = protocol.display_rate_hz;
  setup.area_m = protocol.layout.area_m;
  setup.display = config.display.value_or(NamedDisplay{}).number;
  setup.windowed = config.window == WindowState::windowed;
  setup.dragged = dragged_effector(resolved);
  if (protocol.screens.crop) setup.shown_m = working_box(protocol);
  return setup;
}
}  // namespace

Eigen::AlignedBox3d working_box(const Protocol& protocol) {
  const Layout& layout = protocol.layout;
  int n = 3;
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block)) n = std::max(n, trials->most_cubes());
  const Stage stage = stage_of(protocol, n);
  const double beside_m = layout.cube_size_m / 2 + layout.gap_m;
  const double front_m = layout.row_y_m - layout.cube_size_m / 2 - layout.start_distance_m -
                         stage.effector_size_m.x() / 2;
  const double back_m =
      std::max((layout.area_m.y() + layout.cube_size_m) / 2, layout.row_y_m + layout.cube_size_m);
  return {Eigen::Vector3d(stage.slots_m.front().x() - beside_m, front_m, 0),
          Eigen::Vector3d(stage.slots_m.back().x() + beside_m, back_m, layout.cube_size_m)};
}

Equipment::Equipment(ResolvedConfig config)
    : clock(config->on_wall_clock ? SessionClock::wall_from(0) : SessionClock::virtual_from(0)),
      config_(std::move(config)),
      demonstrated_(demonstrated_apparatus(config_)),
      responder_(config_->model.responder(config_->seed)) {
  if (config_->tracker->has_camera)
    require_size(config_->config, *config_->protocol, config_->apparatus.effector);
  const ViewSetup setup = view_setup(config_);
  pictures_ = open_pictures(*config_->tracker, {*config_->protocol, *responder_, config_->apparatus,
                                                config_->config.tracker.what, clock, config_->seed,
                                                config_->pictures, config_->config.tracker.text,
                                                config_->config.hand == Side::left, setup.dragged});
  view_ = config_->view->make(setup);
}

std::vector<CheckResult> Equipment::check() {
  return check_equipment({*config_->protocol, *pictures_, *responder_, *view_, clock});
}

SessionParts Equipment::parts(Engine& engine, EventSink& sink) {
  SessionParts parts{*config_->protocol, engine, sink,  *pictures_,
                     *responder_,        *view_, clock, config_->view->has_screen};
  (has_person(config_->config) ? parts.texts : parts.asked) =
      config_->texts.pages.empty() ? nullptr : &config_->texts;
  parts.apparatus = demonstrated_;
  parts.has_pictures = config_->tracker->has_pictures;
  parts.left_hand = config_->config.hand == Side::left;
  return parts;
}

}  // namespace heft
