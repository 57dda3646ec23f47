// Resolving options to a session's configuration.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <filesystem>

#include "SourceFolder.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/schema/EventRow.h"
#include "record/temporary_folder.h"
#include "view/ArView.h"

namespace heft {
namespace {

using test::TemporaryFolder;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string root = source_folder();

Protocol quick() {
  return load_protocol(root + "/protocols/quick.toml");
}

SessionOptions options_with(const ResponderChoice& responder, std::optional<Plug> tracker = {},
                            std::optional<Plug> view = {}) {
  SessionOptions options;
  options.responder = responder;
  options.tracker = std::move(tracker);
  options.view = std::move(view);
  return options;
}

SessionOptions model() {
  return options_with(Plug{"simulated"});
}

SessionConfig resolved(const SessionOptions& options, const Protocol& protocol = quick()) {
  return resolve(options, protocol, 7)->config;
}

std::string refusal(const SessionOptions& options, const Protocol& protocol = quick()) {
  try {
    resolve(options, protocol, 7);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Resolve, AModelIsNeitherFilmedNorShown) {
  const ResolvedConfig config = resolve(model(), quick(), 7);
  EXPECT_EQ(config->config.tracker, Plug{"hand"});
  EXPECT_EQ(config->config.view, Plug{"headless"});
  for (const ConfigFile& file :
       {config->config.camera, config->config.board, config->config.effector, config->config.texts})
    EXPECT_EQ(file, ConfigFile{});
  EXPECT_THAT(config->texts.pages, IsEmpty());
  EXPECT_THAT(config->config.participant_parameters, Not(IsEmpty()));
  EXPECT_FALSE(config->on_wall_clock);
}

TEST(Resolve, APersonHasAWindowTextsAndTheShippedApparatus) {
  const ResolvedConfig config = resolve(options_with(Person{}, Plug{"mouse"}), quick(), 7);
  EXPECT_EQ(config->config.view, Plug{"window"});
  EXPECT_THAT(config->config.camera.path, EndsWith("protocols/apparatus/synthetic_camera.yaml"));
  EXPECT_THAT(config->config.board.path, EndsWith("protocols/apparatus/board.toml"));
  EXPECT_THAT(config->config.effector.path, EndsWith("protocols/apparatus/effector.toml"));
  EXPECT_EQ(config->config.board.sha256, sha256(config->config.board.text));
  EXPECT_FALSE(config->apparatus.board.tags.empty());
  EXPECT_EQ(config->config.language, "en");
  EXPECT_FALSE(config->texts.pages.empty());
  EXPECT_EQ(config->config.controls, Side::right);
  EXPECT_THAT(config->config.participant_parameters, IsEmpty());
  EXPECT_TRUE(config->on_wall_clock);
}

TEST(Resolve, WithoutATrackerAPersonIsFilmedByTheFirstCamera) {
  SessionOptions options;
  options.camera_file = root + "/protocols/apparatus/synthetic_camera.yaml";
  EXPECT_EQ(resolved(options).tracker, (Plug{"camera", "0"}));
}

TEST(Resolve, TheProtocolSaysWhatIsNotGiven) {
  Protocol protocol = quick();
  protocol.simulator = {"bullet", 120, {InputMode::hold, 0.01}};
  protocol.onset = {0.5, 0.25};
  const SessionConfig config = resolved(model(), protocol);
  EXPECT_EQ(config.simulator, "bullet");
  EXPECT_EQ(config.rate_hz, 120);
  EXPECT_EQ(config.input, InputMode::hold);
  EXPECT_EQ(config.predict_s, 0.01);
  EXPECT_EQ(config.gap_s, 0.5);
  EXPECT_EQ(config.min_answer_s, 0.25);
  EXPECT_EQ(config.display_rate_hz, protocol.display_rate_hz);
}

TEST(Resolve, WhatIsGivenIsRecordedAsItIs) {
  SessionOptions options = options_with(Person{}, Plug{"hand"});
  options.settings = {{"friction", "0.5"}};
  options.controls = Side::left;
  options.hand = Side::left;
  options.keys = TakesKeys::yes;
  options.display = NamedDisplay{1};
  options.windowed = true;
  options.language = "fr";
  options.simulator = "bullet-ea";
  const SessionConfig config = resolved(options);
  EXPECT_EQ(config.settings, options.settings);
  EXPECT_EQ(config.controls, Side::left);
  EXPECT_EQ(config.hand, Side::left);
  EXPECT_EQ(config.keys, TakesKeys::yes);
  EXPECT_EQ(config.display, options.display);
  EXPECT_EQ(config.window, WindowState::windowed);
  EXPECT_EQ(config.language, "fr");
  EXPECT_EQ(config.simulator, "bullet-ea");
  EXPECT_EQ(config.simulator_reason, "");
}

TEST(Resolve, AMeasuredDisplayIsReadWhereThereIsAScreen) {
  const TemporaryFolder folder;
  SessionOptions options = options_with(Person{}, Plug{"hand"});
  options.display_file = folder.file("display.toml");
  replace_text_file(*options.display_file,
                    "width_px = 1024\nheight_px = 600\nwidth_mm = 154\n"
                    "height_mm = 86\neye_distance_mm = 500\n[latency]\nlight_ms = 23.5\n"
                    "picture_ms = 51\npicture_p5_ms = 44\npicture_p95_ms = 58\n");
  const SessionConfig config = resolved(options);
  EXPECT_EQ(config.display_w_px, 1024);
  EXPECT_EQ(config.eye_distance_mm, 500);
  EXPECT_EQ(config.display_file, options.display_file);
  EXPECT_EQ(config.display_latency_ms.at("light_ms"), 23.5);
  EXPECT_EQ(config.display_latency_ms.at("picture_p95_ms"), 58);
  SessionOptions unseen = model();
  unseen.display_file = options.display_file;
  EXPECT_EQ(resolved(unseen).display_file, "");
}

struct Refused {
  SessionOptions options;
  const char* why;
};

TEST(Resolve, RefusesWhatCanNotWork) {
  SessionOptions recorded = model(), unknown_simulator = model(), straight = model(),
                 unknown_language = model(), uncalibrated;
  recorded.record_camera = "pictures";
  unknown_simulator.simulator = "boxs";
  straight.simulator = "push";
  unknown_language.language = "xx";
  uncalibrated = options_with(Plug{"coin"}, Plug{"frames", "pictures"});
  const Refused cases[] = {
      {options_with(Plug{"simulatd"}), "did you mean \"simulated\"?"},
      {options_with(Plug{"always_no", "x.toml"}), "takes no file"},
      {options_with(Plug{"scripted"}), "scripted:FOLDER"},
      {options_with(Plug{"coin", "none.toml"}), "none.toml"},
      {options_with(Plug{"coin"}, Plug{"hnd"}), "did you mean \"hand\"?"},
      {options_with(Plug{"coin"}, Plug{"hand", "x"}), "takes no argument"},
      {options_with(Plug{"coin"}, Plug{"camera"}), "needs a source"},
      {options_with(Plug{"coin"}, Plug{"synthetic", "none.toml"}), "none.toml"},
      {options_with(Plug{"coin"}, {}, Plug{"windw"}), "did you mean \"window\"?"},
      {options_with(Plug{"coin"}, {}, Plug{"video"}), "video:FILE"},
      {options_with(Plug{"coin"}, {}, Plug{"headless", "x"}), "takes no argument"},
      {recorded, "--record-camera"},
      {unknown_simulator, "did you mean \"boxes\"?"},
      {straight, "straight pushes"},
      {unknown_language, "\"fr\""},
      {uncalibrated, "--camera-file CAMERA.yaml"},
  };
  for (const auto& [options, why] : cases) EXPECT_THAT(refusal(options), HasSubstr(why));
}

TEST(Resolve, ARestingHandIsRefusedWhereAnswersNeedContact) {
  Protocol protocol = quick();
  protocol.require_contact = true;
  for (const char* name :
       {"coin", "always_yes", "always_no", "criterion_only", "start_anchored", "weber"})
    EXPECT_THAT(refusal(options_with(Plug{name}), protocol), HasSubstr("never touches a cube"));
  EXPECT_EQ(refusal(model(), protocol), "");
}

// Every combination of responder, tracker and view, and the reason for refusing it.
TEST(Resolve, SaysWhichPlugsMayMeet) {
  const TemporaryFolder folder;
  const Plug film{"video", folder.file("film.avi")};
  for (const ResponderChoice& who :
       {ResponderChoice(Person{}), ResponderChoice(Plug{"simulated"}),
        ResponderChoice(Plug{"coin"}), ResponderChoice(Plug{"always_no"})})
    for (const char* tracker : {"hand", "synthetic", "mouse"})
      for (const Plug& view : {Plug{"headless"}, Plug{"window"}, film}) {
        const bool person = std::holds_alternative<Person>(who);
        const bool dragged = std::string_view(tracker) == "mouse";
        const char* why = dragged && !person                 ? "moves it without a mouse"
                          : dragged && view.name != "window" ? "dragged in the window"
                          : person && view.name != "window"  ? "cannot see or touch"
                                                             : "";
        const std::string said = refusal(options_with(who, Plug{tracker}, view));
        SCOPED_TRACE(to_text(who) + " " + tracker + " " + view.name);
        EXPECT_EQ(said.empty(), std::string_view(why).empty()) << said;
        EXPECT_THAT(said, HasSubstr(why));
      }
}

TEST(ResolveAgain, WhatWasReadStaysThoughItsFilesAreGone) {
  const TemporaryFolder folder;
  SessionOptions options = options_with(Plug{"coin", folder.file("coin.toml")},
                                        Plug{"synthetic", folder.file("camera.toml")});
  replace_text_file(folder.file("coin.toml"), "p = 0.25\n");
  replace_text_file(folder.file("camera.toml"), "noise_levels = 1\n");
  options.board_file = folder.file("board.toml");
  replace_text_file(*options.board_file, read_text_file(root + "/protocols/apparatus/board.toml"));
  const SessionConfig first = resolved(options);
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    std::filesystem::remove(file.path());
  EXPECT_EQ(resolve({}, first, quick(), 7)->config, first);
  EXPECT_EQ(resolve({}, first, quick(), 7)->config.participant_parameters.at("p"), 0.25);
}

TEST(ResolveAgain, OnlyWhatIsGivenChanges) {
  SessionConfig before = resolved(options_with(Person{}, Plug{"synthetic"}));
  SessionOptions words;
  words.language = "fr";
  const SessionConfig after = resolve(words, before, quick(), 7)->config;
  EXPECT_EQ(after.language, "fr");
  before.texts = after.texts;
  before.language = after.language;
  EXPECT_EQ(after, before);
}

TEST(ResolveAgain, FilesThatWereNotNeededBeforeAreReadNow) {
  const SessionConfig before = resolved(model());
  const SessionConfig after =
      resolve(options_with(Person{}, Plug{"synthetic"}, Plug{"window"}), before, quick(), 7)
          ->config;
  EXPECT_FALSE(after.camera.text.empty());
  EXPECT_FALSE(after.texts.text.empty());
  const SessionConfig model_again =
      resolve(options_with(Plug{"simulated"}, Plug{"hand"}, Plug{"headless"}), after, quick(), 7)
          ->config;
  EXPECT_EQ(model_again, before);
}

TEST(ResolveAgain, AFilmIsWrittenBesideTheOneFromBefore) {
  const TemporaryFolder folder;
  const Plug film{"video", folder.file("film.avi")};
  const ResolvedConfig first = resolve(options_with(Plug{"coin"}, {}, film), quick(), 7);
  EXPECT_EQ(first->film, film.what);
  replace_text_file(film.what, "");
  const ResolvedConfig second = resolve({}, first->config, quick(), 7);
  EXPECT_EQ(second->film, folder.file("film-2.avi"));
  EXPECT_EQ(second->config.view, film) << "the log names the session's film";
}

SessionOptions any_options() {
  const auto chance = [] { return *rc::gen::arbitrary<bool>(); };
  SessionOptions options;
  options.responder = *rc::gen::element<ResponderChoice>(Person{}, Plug{"simulated"}, Plug{"coin"});
  const bool person = std::holds_alternative<Person>(*options.responder);
  options.tracker = *rc::gen::element(Plug{"hand"}, Plug{"synthetic"});
  if (!person)
    options.view = *rc::gen::element(Plug{"headless"}, Plug{"window"}, Plug{"video", "none.avi"});
  if (chance()) options.simulator = *rc::gen::element<std::string>("boxes", "bullet", "auto");
  if (chance()) options.language = *rc::gen::element<std::string>("en", "fr");
  if (chance()) options.display = NamedDisplay{*rc::gen::inRange(0, 4)};
  if (chance()) options.controls = *rc::gen::element(Side::left, Side::right);
  if (chance()) options.hand = *rc::gen::element(Side::left, Side::right);
  if (chance()) options.keys = *rc::gen::element(TakesKeys::no, TakesKeys::yes);
  options.windowed = chance();
  if (chance()) options.settings = {{"title", "\"a=b\""}, {"screens.crop", "true"}};
  return options;
}

RC_GTEST_PROP(ResolveAgain, ALoggedConfigurationResolvesToItself, ()) {
  const SessionOptions options = any_options();
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
  const Protocol protocol = quick();
  const SessionConfig first = resolve(options, protocol, seed)->config;
  const std::string text = to_json(first);
  const SessionConfig logged = setup_from_json(text);
  RC_ASSERT(logged == first);
  RC_ASSERT(to_json(logged) == text);
  RC_ASSERT(resolve({}, logged, protocol, seed)->config == first);
}

TEST(ResolvedConfig, EachSessionDrawsItsParticipant) {
  SessionOptions varied = model();
  const TemporaryFolder folder;
  varied.responder = Plug{"simulated", folder.file("people.toml")};
  replace_text_file(folder.file("people.toml"), "participant_spread = 1\n");
  const ResolvedConfig one = resolve(varied, quick(), 7);
  const ResolvedConfig other = one.with_seed(8);
  EXPECT_EQ(other->seed, 8U);
  EXPECT_NE(one->config.participant_parameters, other->config.participant_parameters);
  EXPECT_EQ(other->config, resolve(varied, quick(), 8)->config);
}

const DisplayFacts lab{1, "DELL", 1024, 600, 60, 1.5};

TEST(WithDevices, HasWhatTheWindowReports) {
  const SessionConfig config = with_devices({}, {lab, {}});
  EXPECT_EQ(config.display, (NamedDisplay{1, "DELL"}));
  EXPECT_EQ(to_text(config.display), "1 DELL");
  EXPECT_EQ(config.display_w_px, 1024);
  EXPECT_EQ(config.display_h_px, 600);
  EXPECT_EQ(config.refresh_hz, 60);
  EXPECT_EQ(config.display_scale, 1.5);
  EXPECT_EQ(config.window, WindowState::full_screen);
  EXPECT_FALSE(config.display_w_mm) << "it was not measured";
  EXPECT_EQ(with_devices({}, {}), SessionConfig{});
}

TEST(WithDevices, HasASourcesRateWhereItIsNotTheDisplays) {
  SessionConfig config;
  config.display_rate_hz = 30;
  EXPECT_EQ(with_devices(config, {{}, 29.97}).source_rate_hz, std::nullopt);
  EXPECT_EQ(with_devices(config, {{}, 15}).source_rate_hz, 15);
}

TEST(WithDevices, AnotherDisplayThanTheMeasuredOneIsRefused) {
  SessionConfig measured;
  measured.display_file = "/lab/display.toml";
  measured.display_w_px = 1920;
  measured.display_h_px = 1080;
  measured.display_w_mm = 500;
  try {
    with_devices(measured, {lab, {}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::invalid_file);
    EXPECT_THAT(error.what(), HasSubstr("/lab/display.toml"));
    EXPECT_THAT(error.what(), HasSubstr("heft calibrate display"));
  }
  measured.display_w_px = 1024;
  measured.display_h_px = 600;
  EXPECT_EQ(with_devices(measured, {lab, {}}).display_w_mm, 500);
}

}  // namespace
}  // namespace heft
