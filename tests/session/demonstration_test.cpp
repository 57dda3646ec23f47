// The demonstration before the first trial: a filmed hand that holds the effector as participants
// should, pushes the cubes, and looks as in a trial.
#include "session/Demonstration.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "SourceFolder.h"
#include "apparatus/ShippedApparatus.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "session/Equipment.h"
#include "session/MadeUpPeople.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "tracking/Tracker.h"
#include "tracking/detection/MarkerBody.h"
#include "view/scene/SceneDrawing.h"

namespace heft {
namespace {

using testing::MadeUpScreen;
using testing::patient;
using testing::quick_protocol;
using testing::shared;

const std::string shipped = source_folder() + "/protocols/apparatus/";

double degrees_from(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b) * 180 / M_PI;
}

// A tracker must find the effector in the pictures where its clone is drawn.
TEST(Demonstration, ShowsAFilmedEffectorUnderItsCloneWithTwoFacesToTheCamera) {
  const Protocol protocol;
  Demonstration demonstration(protocol, shipped_apparatus(), 7);
  Tracker tracker(shipped_apparatus());
  int n_two_faces = 0;
  constexpr int n_pictures = 60;
  for (int i = 0; i < n_pictures; ++i) {
    const double t_s = i / 3.0;
    const ViewFrame shown = demonstration.at(t_s);
    ASSERT_TRUE(shown.camera && shown.camera_from_board && shown.frame.clone);
    const TrackedPicture tracked = tracker.track(*shown.camera, t_s);
    ASSERT_TRUE(tracked.board_from_effector) << t_s;
    const Pose& clone = *shown.frame.clone;
    EXPECT_LT((tracked.board_from_effector->position_m - clone.position_m).norm(), 0.003) << t_s;
    EXPECT_LT(degrees_from(tracked.board_from_effector->orientation, clone.orientation), 3) << t_s;
    EXPECT_LT((tracked.camera_from_board->position_m - shown.camera_from_board->position_m).norm(),
              0.002);
    if (tracked.n_effector_faces >= 2) ++n_two_faces;
  }
  EXPECT_GT(n_two_faces, 0.9 * n_pictures);
}

// Cubes are drawn over the film; where the hand is, they are not.
TEST(Demonstration, NeverDrawsACubeOverTheHand) {
  const Protocol protocol;
  Demonstration demonstration(protocol, shipped_apparatus(), 7);
  ViewSetup setup;
  setup.stage = stage_of(protocol, 3);
  setup.camera = shipped_apparatus().camera;
  SceneDrawing drawing(setup);
  int n_hand_px = 0, n_hidden_px = 0;
  for (double t_s = 0.5; t_s < 20; t_s += 0.5) {
    ViewFrame shown = demonstration.at(t_s);
    ASSERT_TRUE(shown.in_front);
    shown.frame.clone.reset();  // that is seen over fingers in trials too
    const Image drawn = drawing.draw(shown);
    shown.in_front.reset();
    const Image without_hand = drawing.draw(shown);
    const ViewFrame again = demonstration.at(t_s);
    for (std::size_t i = 0; i < again.in_front->pixels.size(); ++i) {
      if (again.in_front->pixels[i] < 255) continue;
      ++n_hand_px;
      const bool as_filmed =
          std::equal(&drawn.pixels[3 * i], &drawn.pixels[3 * i] + 3, &again.camera->pixels[3 * i]);
      ASSERT_TRUE(as_filmed) << t_s;
      n_hidden_px += !std::equal(&without_hand.pixels[3 * i], &without_hand.pixels[3 * i] + 3,
                                 &again.camera->pixels[3 * i]);
    }
  }
  EXPECT_GT(n_hand_px, 100000);
  EXPECT_GT(n_hidden_px, 0) << "nothing was in its way: this test looks at nothing";
}

TEST(Demonstration, PushesEveryCubeForwardAndNoneOver) {
  const Protocol protocol;
  const Stage stage = stage_of(protocol, 3);
  Demonstration demonstration(protocol, {}, 7);
  std::vector<double> pushed_m(3);
  for (double t_s = 0; t_s < 60; t_s += 1 / protocol.display_rate_hz) {
    const DisplayedFrame frame = demonstration.at(t_s).frame;
    for (std::size_t i = 0; i < frame.cubes.size(); ++i) {
      pushed_m[i] = std::max(pushed_m[i], frame.cubes[i].position_m.y() - stage.slots_m[i].y());
      const Eigen::Vector3d up = frame.cubes[i].orientation * Eigen::Vector3d::UnitZ();
      EXPECT_GT(up.z(), 0.9) << "cube " << i << " at " << t_s;
    }
  }
  for (const double each_m : pushed_m) EXPECT_GT(each_m, 0.02);
}

TEST(Demonstration, NeverDipsTheEffectorIntoTheTable) {
  const Protocol protocol;
  Demonstration demonstration(protocol, {}, 7);
  for (double t_s = 0; t_s < 60; t_s += 0.1) {
    const Pose effector = demonstration.at(t_s).frame.effector;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5})
          EXPECT_GT(
              (effector * protocol.effector_size_m.cwiseProduct(Eigen::Vector3d(x, y, z))).z(), 0);
  }
}

TEST(Demonstration, IsDrawnOnAPlainTableWhereNothingCanBeFilmed) {
  const Protocol protocol;
  Demonstration demonstration(protocol, {}, 7);
  const ViewFrame shown = demonstration.at(3);
  EXPECT_FALSE(shown.camera);
  EXPECT_TRUE(shown.frame.tracked);
}

struct Demonstrated {
  explicit Demonstrated(const Apparatus& filmed, bool has_person) {
    Protocol made = quick_protocol();
    made.display_rate_hz = 30;
    made.blocks.insert(made.blocks.begin(), DemonstrationBlock{"demonstration", 0.3});
    protocol = shared(std::move(made));
    Engine engine(protocol, 7);
    RecordedSession sink{SessionHeader{}};
    SessionClock clock = has_person ? SessionClock::wall_from(0) : SessionClock::virtual_from(0);
    const auto hand = responder_named("simulated").make({});
    HandPictures pictures(*hand, protocol->display_rate_hz);
    MadeUpScreen screen([this](const ViewFrame& picture, const ScreenState& state) {
      if (state.screen == Screen::demonstration) shown.push_back(picture);
      return patient(picture, state);
    });
    const ScreenTexts texts = load_texts(source_folder() + "/protocols/texts/en.toml");
    end = Runner({*protocol, engine, sink, pictures, *hand, screen, clock, has_person,
                  has_person ? &texts : nullptr, filmed},
                 {})
              .run();
  }

  std::shared_ptr<const Protocol> protocol;
  std::vector<ViewFrame> shown;
  RunEnd end;
};

TEST(Demonstration, IsFilmedForAPersonAtTheirPage) {
  const Demonstrated session(shipped_apparatus(), true);
  EXPECT_EQ(session.end, RunEnd::finished);
  ASSERT_FALSE(session.shown.empty());
  for (const ViewFrame& picture : session.shown) EXPECT_TRUE(picture.camera);
}

TEST(Demonstration, IsNotRenderedForAModel) {
  const Protocol protocol;
  Apparatus impossible = shipped_apparatus();
  impossible.board.tags[0].corners_m[0].z() = 0.1;
  EXPECT_THROW(Demonstration(protocol, impossible, 7), Error);
  EXPECT_EQ(Demonstrated(impossible, false).end, RunEnd::finished);
}

// A person's session as the command line sets it up.
Apparatus demonstrated_with(SessionOptions options, const Protocol& protocol) {
  setenv("SDL_VIDEODRIVER", "offscreen", 1);
  options.view = Plug{"window"};
  Equipment equipment(resolve(options, protocol, 7));
  Engine engine(shared(protocol), 7);
  RecordedSession sink{SessionHeader{}};
  return equipment.parts(engine, sink).apparatus;
}

TEST(WorkingBox, HoldsWholeCubesFromTheirSlotsToTheFarEdge) {
  const Protocol protocol = quick_protocol();
  const Layout& layout = protocol.layout;
  const Eigen::AlignedBox3d box = working_box(protocol);
  for (const Eigen::Vector3d& slot_m : slot_positions(layout, 3))
    for (const double y_m : {layout.row_y_m, layout.area_m.y() / 2}) {
      const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(layout.cube_size_m / 2);
      const Eigen::Vector3d center_m(slot_m.x(), y_m, half_m.z());
      EXPECT_TRUE(box.contains(Eigen::AlignedBox3d(center_m - half_m, center_m + half_m))) << y_m;
    }
}

SessionOptions options_of(const ResponderChoice& responder, const std::string& tracker) {
  SessionOptions options;
  options.responder = responder;
  options.tracker = Plug{tracker};
  return options;
}

TEST(Demonstration, ShowsThePrintedBoardAndEffectorWithoutACameraToo) {
  const Apparatus shown = demonstrated_with(options_of(Person{}, "hand"), quick_protocol());
  EXPECT_EQ(shown.board.tags.size(), shipped_apparatus().board.tags.size());
  EXPECT_EQ(shown.effector.tags.size(), shipped_apparatus().effector.tags.size());

  Protocol larger = quick_protocol();
  larger.effector_size_m.x() += 0.02;
  const MarkerBody box = demonstrated_with(options_of(Person{}, "hand"), larger).effector;
  EXPECT_EQ(box.size_m, larger.effector_size_m);
  EXPECT_TRUE(box.tags.empty()) << "no print is of that size";
}

TEST(Demonstration, ShowsTheSessionsOwnApparatusWhereThereIsOne) {
  const Apparatus shown = demonstrated_with(options_of(Person{}, "synthetic"), quick_protocol());
  EXPECT_EQ(shown.camera.distortion, shipped_apparatus().camera.distortion);
  EXPECT_FALSE(shown.board.tags.empty());
}

TEST(Demonstration, NeedsNoBoardWhereAModelTakesPart) {
  EXPECT_TRUE(demonstrated_with(options_of(Plug{"simulated"}, "hand"), quick_protocol())
                  .board.tags.empty());
}

}  // namespace
}  // namespace heft
