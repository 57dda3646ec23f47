#include "session/Equipment.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "protocol/Files.h"
#include "responders/Hand.h"

namespace heft {

namespace {
constexpr double same_size_m = 0.0015;  // a printer's 1 % off, measured and written down

bool has_size(const MarkerBody& effector, const Eigen::Vector3d& size_m) {
  return (effector.size_m - size_m).cwiseAbs().maxCoeff() < same_size_m;
}

// What people hold must be what the simulated one looks like.
void require_size(const Protocol& protocol, const MarkerBody& effector,
                  const SessionConfig& options) {
  const Eigen::Vector3d& size_m = protocol.effector_size_m;
  if (has_size(effector, size_m)) return;
  throw Error(fmt::format("{} is {:.4g} x {:.4g} x {:.4g} m, but the protocol's [effector] size_m "
                          "is [{:.4g}, {:.4g}, {:.4g}]; make them the same",
                          options.effector_file, effector.size_m.x(), effector.size_m.y(),
                          effector.size_m.z(), size_m.x(), size_m.y(), size_m.z()),
              ExitCode::invalid_file);
}

Apparatus fitting_apparatus(const Protocol& protocol, const SessionConfig& options) {
  Apparatus apparatus = apparatus_of(options);
  if (!apparatus.effector.tags.empty()) require_size(protocol, apparatus.effector, options);
  return apparatus;
}

void require_questions(const Protocol& protocol) {
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block); trials && trials->lacks_question())
      throw Error(fmt::format("block {} asks a question of the questionnaire {} that the session's "
                              "texts do not have; expected one that is answered on the screen",
                              trials->name(), *trials->questionnaire()),
                  ExitCode::invalid_file);
}

// What the demonstration shows where the session itself films nothing: the board and effector that
// would be filmed, as far as the options have them. Of another size than these there is no print.
Apparatus unfilmed_apparatus(const Protocol& protocol, const SessionConfig& options) {
  if (!has_person(options) || options.board_text.empty()) return {};
  Apparatus apparatus{{},
                      parse_board(options.board_text, options.board_file),
                      parse_effector(options.effector_text, options.effector_file)};
  if (!has_size(apparatus.effector, protocol.effector_size_m)) {
    apparatus.effector = {};
    apparatus.effector.size_m = protocol.effector_size_m;
  }
  return apparatus;
}

// The row with most cubes and as much as a gap beside it, in front of it the resting effector's
// fore half, behind it all that cubes can be pushed.
Eigen::AlignedBox3d working_box(const Protocol& protocol) {
  const Layout& layout = protocol.layout;
  int n = 3;
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block)) n = std::max(n, trials->most_cubes());
  const Stage stage = stage_of(protocol, n);
  const double beside_m = layout.cube_size_m / 2 + layout.gap_m;
  const double front_m = layout.row_y_m - layout.cube_size_m / 2 - layout.start_distance_m -
                         stage.effector_size_m.x() / 2;
  const double back_m = std::max(layout.area_m.y() / 2, layout.row_y_m + layout.cube_size_m);
  return {Eigen::Vector3d(stage.slots_m.front().x() - beside_m, front_m, 0),
          Eigen::Vector3d(stage.slots_m.back().x() + beside_m, back_m, layout.cube_size_m)};
}

ViewSetup view_setup(const Protocol& protocol, const SessionConfig& options,
                     const Apparatus& apparatus) {
  ViewSetup setup;
  setup.stage = stage_of(protocol, 3);
  if (!apparatus.board.tags.empty()) setup.camera = apparatus.camera;
  if (!options.texts_text.empty())
    setup.texts = parse_texts(options.texts_text, options.texts_file);
  setup.left_handed = options.handed == "left";
  setup.takes_keys = options.keys == "yes";
  setup.text_size = protocol.screens.text_size;
  setup.patch = protocol.screens.patch;
  setup.file = split_name(options.view).file;
  setup.rate_hz = protocol.display_rate_hz;
  setup.area_m = protocol.layout.area_m;
  setup.display = display_number(options);
  setup.windowed = is_windowed(options);
  if (protocol.screens.crop) setup.shown_m = working_box(protocol);
  return setup;
}

// Where a model's hand would rest; none where it is not dragged.
std::shared_ptr<DraggedEffector> dragged_effector(const Protocol& protocol,
                                                  const SessionConfig& options) {
  constexpr double hover_m = 0.005;
  if (!tracker_named(options.tracker).is_dragged) return {};
  return std::make_shared<DraggedEffector>(resting_pose(stage_of(protocol, 3), hover_m));
}
}  // namespace

Equipment::Equipment(std::shared_ptr<const Protocol> protocol, const SessionConfig& options,
                     std::uint64_t seed)
    : clock(runs_on_wall_clock(options) ? SessionClock::wall_from(0)
                                        : SessionClock::virtual_from(0)),
      protocol_(std::move(protocol)),
      seed_(seed),
      has_person_(has_person(options)),
      left_hand_(options.hand == "left"),
      responder_(make_responder(options, seed)) {
  const Apparatus apparatus = fitting_apparatus(*protocol_, options);
  setup_ = view_setup(*protocol_, options, apparatus);
  setup_.dragged = dragged_effector(*protocol_, options);
  demonstrated_ =
      apparatus.board.tags.empty() ? unfilmed_apparatus(*protocol_, options) : apparatus;
  pictures_ = open_pictures(
      options.tracker,
      {*protocol_, *responder_, apparatus, split_name(options.tracker).file, clock, seed,
       options.record_camera, options.tracker_text, left_hand_, setup_.dragged});
  const ViewEntry& view = view_named(split_name(options.view).name);
  has_screen_ = view.has_screen;
  if (!setup_.texts.pages.empty()) require_questions(*protocol_);
  if (has_person_ || has_screen_) require_words(setup_.texts, *protocol_, options.texts_file);
  view_ = view.make(setup_);
}

SessionParts Equipment::parts(Engine& engine, EventSink& sink) {
  SessionParts parts{*protocol_, engine, sink, *pictures_, *responder_, *view_, clock, has_screen_};
  (has_person_ ? parts.texts : parts.asked) = setup_.texts.pages.empty() ? nullptr : &setup_.texts;
  parts.apparatus = demonstrated_;
  parts.left_hand = left_hand_;
  return parts;
}

}  // namespace heft
