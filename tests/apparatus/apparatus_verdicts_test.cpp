// The verdicts of heft doctor on measured figures, whichever camera they are from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apparatus/checks/ApparatusCheck.h"
#include "base/Error.h"
#include "tracking/Scenes.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Pictures with none, one and two of the effector's faces in view.
Pictures seen_with_faces(int n_none, int n_one, int n_two) {
  Pictures pictures;
  const auto add = [&](int n, int n_faces) {
    for (int i = 0; i < n; ++i) {
      LookedAt seen;
      seen.tracked.n_effector_faces = n_faces;
      if (n_faces > 0) seen.tracked.board_from_effector = Pose{};
      pictures.push_back(seen);
    }
  };
  add(n_none, 0);
  add(n_one, 1);
  add(n_two, 2);
  return pictures;
}

TEST(EffectorVerdict, CountsPicturesWithTwoFaces) {
  const CheckResult result = effector_verdict(seen_with_faces(0, 9, 11));
  EXPECT_EQ(result.verdict, CheckVerdict::ok);
  EXPECT_THAT(result.finding, HasSubstr("two faces or more in 55 %"));
  EXPECT_THAT(result.finding, Not(HasSubstr("turn the effector")));
}

TEST(EffectorVerdict, AdvisesToTurnItWhereOneFaceIsMostlyAlone) {
  const CheckResult result = effector_verdict(seen_with_faces(0, 49, 1));
  EXPECT_EQ(result.verdict, CheckVerdict::ok);
  EXPECT_THAT(result.finding, HasSubstr("two faces or more in 2 %"));
  EXPECT_THAT(result.finding, HasSubstr("turn the effector slightly about its axis"));
}

TEST(EffectorVerdict, WarnsOfAnEffectorThatIsOftenLost) {
  const CheckResult result = effector_verdict(seen_with_faces(5, 0, 5));
  EXPECT_EQ(result.verdict, CheckVerdict::warning);
  EXPECT_THAT(result.finding, HasSubstr("seen in 50 % of pictures"));
  EXPECT_EQ(effector_verdict(seen_with_faces(5, 0, 0)).verdict, CheckVerdict::warning);
}

TEST(ToneVerdict, NamesACameraThatBends) {
  const ToneCurve srgb, bent(ToneBend(0.6, 0, 0));
  Intrinsics camera;
  EXPECT_EQ(tone_verdict(camera, srgb).verdict, CheckVerdict::ok);
  EXPECT_THAT(tone_verdict(camera, srgb).finding, HasSubstr("close to sRGB"));
  const CheckResult untold = tone_verdict(camera, bent);
  EXPECT_EQ(untold.verdict, CheckVerdict::warning);
  EXPECT_THAT(untold.finding, HasSubstr("the camera bends tones"));
  EXPECT_THAT(untold.finding, HasSubstr("calibrate again"));
  camera.response = std::array{0.6, 0.0, 0.0};
  const CheckResult told = tone_verdict(camera, bent);
  EXPECT_EQ(told.verdict, CheckVerdict::ok);
  EXPECT_THAT(told.finding, HasSubstr("the camera bends tones"));
  EXPECT_EQ(tone_verdict(camera, srgb).verdict, CheckVerdict::warning);
  EXPECT_THAT(tone_verdict(camera, srgb).finding, HasSubstr("it differs from the calibration"));
}

// Pictures of a camera as the verdicts see them.
std::vector<CheckResult> verdicts_of(const Optics& optics, const Apparatus& filmed,
                                     const Apparatus& apparatus, int n_pictures = 5) {
  SyntheticSettings settings;
  settings.optics = optics;
  SyntheticCamera camera(filmed, settings, 3);
  ApparatusCheck check(apparatus);
  for (int i = 0; i < n_pictures; ++i) {
    const double t_s = i / 15.0;
    CameraPicture picture;
    picture.image = camera.picture(out_of_view, t_s, static_cast<std::uint64_t>(i));
    picture.capture_s = t_s;
    picture.number = i;
    check.see(picture, -1);
  }
  return check.results({}, 15, false);
}

CheckVerdict verdict_on(const std::string& name, const std::vector<CheckResult>& results) {
  const auto found = std::ranges::find(results, name, &CheckResult::name);
  if (found == results.end()) throw Error("no verdict on " + name);
  return found->verdict;
}

TEST(PictureVerdicts, NameBlurNoiseAndSecondPrints) {
  const Apparatus apparatus = default_apparatus(640);
  const auto usual = verdicts_of({}, apparatus, apparatus);
  for (const char* name : {"sharpness", "noise", "doubles", "tag size"})
    EXPECT_EQ(verdict_on(name, usual), CheckVerdict::ok) << name;
  Optics defocused, noisy;
  defocused.blur_px = 1.6;
  noisy.noise = 10;
  EXPECT_EQ(verdict_on("sharpness", verdicts_of(defocused, apparatus, apparatus)),
            CheckVerdict::warning);
  EXPECT_EQ(verdict_on("noise", verdicts_of(noisy, apparatus, apparatus)), CheckVerdict::warning);
  Apparatus doubled = apparatus;
  doubled.board.tags[0].id = doubled.board.tags[7].id;
  EXPECT_EQ(verdict_on("doubles", verdicts_of({}, doubled, apparatus)), CheckVerdict::warning);
  Apparatus enlarged = apparatus;
  enlarged.board = with_scaled_tags(apparatus.board, 1.01);
  EXPECT_EQ(verdict_on("tag size", verdicts_of({}, enlarged, apparatus)), CheckVerdict::warning);
}

TEST(LockVerdicts, HaveALineForEachControl) {
  CameraMode mode;
  mode.locked = {"gain 12", "power line 50 Hz"};
  mode.not_locked = {"dynamic frame rate: the camera takes fewer pictures in dim light; add light"};
  const auto results = lock_verdicts(mode);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].name, "gain");
  EXPECT_EQ(results[0].finding, "locked: 12");
  EXPECT_EQ(results[1].name, "power line");
  EXPECT_EQ(results[1].finding, "locked: 50 Hz");
  EXPECT_EQ(results[2].name, "dynamic frame rate");
  EXPECT_EQ(results[2].verdict, CheckVerdict::warning);
}

TEST(StreamVerdicts, NameGhostsFlickerGainAndFocus) {
  const Apparatus apparatus = default_apparatus(640);
  const auto usual = verdicts_of({}, apparatus, apparatus, 15);
  for (const char* name : {"ghosting", "flicker", "gain", "lost pictures", "focal length"})
    EXPECT_EQ(verdict_on(name, usual), CheckVerdict::ok) << name;
  const auto verdict_of = [&](const std::string& name, const Optics& optics) {
    return verdict_on(name, verdicts_of(optics, apparatus, apparatus, 15));
  };
  EXPECT_EQ(verdict_of("ghosting", {.last_picture = 0.3}), CheckVerdict::warning);
  EXPECT_EQ(verdict_of("flicker", {.readout_s = 0.02, .flicker = 0.1}), CheckVerdict::warning);
  EXPECT_EQ(verdict_of("flicker", {.flicker = 0.1}), CheckVerdict::warning);  // all rows at once
  EXPECT_EQ(verdict_of("gain", {.flicker = 0.1}), CheckVerdict::ok);
  EXPECT_EQ(verdict_of("gain", {.auto_gain = 0.2}), CheckVerdict::warning);
  EXPECT_EQ(verdict_of("flicker", {.auto_gain = 0.2}), CheckVerdict::ok);
  EXPECT_EQ(verdict_of("lost pictures", {.repeated = 0.3}), CheckVerdict::warning);
  EXPECT_EQ(verdict_of("focal length", {.breathing = 0.004}), CheckVerdict::warning);
}

TEST(StreamVerdicts, CountLostPicturesByTimesAndNumbers) {
  const auto lost = [](const std::vector<int>& times, const std::vector<int>& numbers) {
    Pictures pictures(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      pictures[i].capture_s = times[i] / 30.0;
      pictures[i].number = numbers[i];
    }
    return lost_verdict(pictures).finding;
  };
  EXPECT_THAT(lost({0, 1, 2, 4, 5, 8}, {0, 1, 2, 3, 4, 5}), HasSubstr("3 of 9 were lost"));
  // Pictures that the program dropped because it was too slow are not lost by the camera.
  EXPECT_THAT(lost({0, 1, 2, 4, 5, 8}, {0, 1, 2, 4, 5, 8}), HasSubstr("0 of 9 were lost"));
}

TEST(BoardVerdict, SaysWhyItMayBeInNoPicture) {
  const CheckResult result = board_verdict(Pictures(7), {}, "the picture is mirrored");
  EXPECT_EQ(result.verdict, CheckVerdict::failed);
  EXPECT_EQ(result.finding, "found in 0 of 7 pictures: the picture is mirrored");
}

TEST(LockVerdicts, WarnOfALensThatIsNotWhereItWasCalibrated) {
  CameraMode mode;
  mode.not_locked = {
      "focus: calibrated at 35, but it is at 120 and the driver does not change that"};
  const auto results = lock_verdicts(mode);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].verdict, CheckVerdict::warning);
  EXPECT_EQ(results[0].name, "focus");
  EXPECT_THAT(results[0].finding, HasSubstr("calibrated at 35"));
}

}  // namespace
}  // namespace heft
