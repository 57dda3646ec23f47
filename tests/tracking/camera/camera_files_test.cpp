// Pictures, folders of pictures and video files as cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "base/Error.h"
#include "record/temporary_folder.h"
#include "tracking/camera/Camera.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/codecs/Codecs.h"

namespace heft {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

Image plain(std::uint8_t level, int channels = 3) {
  Image image(32, 24, channels);
  std::ranges::fill(image.pixels, level);
  return image;
}

template <typename Do>
std::string message_of(Do&& what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(ImageFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    Image image = plain(0, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = static_cast<std::uint8_t>(i * 7);
    for (const char* name : {"a.png", "a.BMP", "a.tif"}) {
      write_image(folder.file(name), image);
      const Image read = read_image(folder.file(name));
      EXPECT_EQ(read.channels, channels) << name;
      EXPECT_EQ(read.width, 32) << name;
      EXPECT_EQ(read.pixels, image.pixels) << name;
    }
  }
}

TEST(ImageFile, RefusesTooManyPixels) {
  const TemporaryFolder folder;
  write_image(folder.file("a.png"), Image(10001, 10000, 1));
  EXPECT_THAT(message_of([&] { read_image(folder.file("a.png")); }),
              HasSubstr("larger than 1e+08 pixels"));
}

TEST(PictureFolder, RefusesAPictureOfAnotherSize) {
  const TemporaryFolder folder;
  write_image(folder.file("a.png"), plain(9));
  write_image(folder.file("b.png"), Image(64, 48, 1));
  const auto camera = open_camera("frames", folder.file(""));
  ASSERT_TRUE(camera->next(0));
  EXPECT_THAT(message_of([&] { camera->next(0); }),
              AllOf(HasSubstr("b.png is 64 x 48 pixels"), HasSubstr("a.png, has 32 x 24")));
}

TEST(ImageFile, CodecsDoNotTalk) {
  const TemporaryFolder folder;
  Image image(64, 48, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i * i % 251);
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
    write_image(folder.file(name), image);
    std::filesystem::resize_file(folder.file(name),
                                 std::filesystem::file_size(folder.file(name)) / 2);
    testing::internal::CaptureStderr();
    message_of([&] { read_image(folder.file(name)); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
  }
  testing::internal::CaptureStderr();
  std::fputs("heard again", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "heard again");
}

TEST(ImageFile, NamesWhatItCanNotReadOrWrite) {
  const TemporaryFolder folder;
  const auto reading = [&](const std::string& name) {
    return message_of([&] { read_image(folder.file(name)); });
  };
  EXPECT_THAT(reading("none.png"), AllOf(HasSubstr("there is no"), HasSubstr("none.png")));
  write_text(folder.file("text.png"), "no picture at all");
  EXPECT_THAT(reading("text.png"), AllOf(HasSubstr("text.png"), HasSubstr("damaged")));
  write_text(folder.file("empty.jpg"), "");
  EXPECT_THAT(reading("empty.jpg"), HasSubstr("empty.jpg"));
  EXPECT_THAT(reading("."), HasSubstr("not a file"));
  const auto writing = [&](const std::string& name) {
    return message_of([&] { write_image(folder.file(name), plain(1)); });
  };
  EXPECT_THAT(writing("a.xyz"), HasSubstr(".png"));
  EXPECT_THAT(writing("missing/a.png"), HasSubstr("missing/a.png"));
}

TEST(PictureFolder, ComesInNaturalOrderAtThirtyASecond) {
  const TemporaryFolder folder;
  for (const char* name : {"frame_10.png", "frame_2.png", "frame_1.png", "frame_002b.png"})
    write_image(folder.file(name), plain(50));
  write_text(folder.file("notes.txt"), "no picture");
  const auto camera = open_camera("frames", folder.path());
  EXPECT_FALSE(camera->is_live());
  EXPECT_EQ(camera->mode().width_px, 32);
  EXPECT_NEAR(camera->mode().rate_hz, 30, 1e-9);
  std::vector<std::string> names;
  while (!camera->ended()) {
    const auto picture = camera->next(0);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->number, static_cast<std::int64_t>(names.size()));
    EXPECT_NEAR(picture->capture_s, static_cast<double>(names.size()) / 30, 1e-12);
    names.push_back(picture->name);
  }
  EXPECT_THAT(names,
              testing::ElementsAre("frame_1.png", "frame_2.png", "frame_002b.png", "frame_10.png"));
  EXPECT_FALSE(camera->next(0));
}

TEST(PictureFolder, TakesItsTimesFromTheTableBesideThePictures) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png", "c.png"}) write_image(folder.file(name), plain(50));
  const auto with_times = [&](const std::string& text) {
    write_text(folder.file("times.csv"), text);
    return open_camera("frames", folder.path());
  };
  const auto camera = with_times("frame,t_s\r\nc.png,10.25\r\na.png,10\r\nb.png,10.1\r\n");
  for (const double t_s : {0.0, 0.1, 0.25}) EXPECT_NEAR(camera->next(0)->capture_s, t_s, 1e-9);
  EXPECT_NEAR(camera->mode().rate_hz, 8, 1e-9);

  const auto refusal = [&](const std::string& text) {
    return message_of([&] { with_times(text); });
  };
  EXPECT_THAT(refusal("name,time\n"), HasSubstr("times.csv:1:1"));
  EXPECT_THAT(refusal("frame,t_s\na.png,x\n"), HasSubstr("times.csv:2:1"));
  EXPECT_THAT(refusal("frame,t_s\na.png,1\na.png,2\n"), HasSubstr("times.csv:3:1"));
  EXPECT_THAT(refusal("frame,t_s\na.png,1\nb.png,2\n"), HasSubstr("c.png"));
  EXPECT_THAT(refusal("frame,t_s\na.png,1\nb.png,2\nc.png,2\n"), HasSubstr("increase"));
}

TEST(PictureFolder, RefusesMissingPicturesAndWhatIsNoFile) {
  const TemporaryFolder folder;
  write_image(folder.file("a.png"), plain(50));
  const auto opening = [&] { return message_of([&] { open_camera("frames", folder.path()); }); };
  write_text(folder.file("times.csv"), "frame,t_s\na.png,1\nb.png,2\n");
  EXPECT_THAT(opening(), AllOf(HasSubstr("times.csv has a time for b.png"), HasSubstr("no such")));
  std::filesystem::create_symlink(folder.file("nowhere"), folder.file("b.png"));
  EXPECT_THAT(opening(), AllOf(HasSubstr("b.png"), HasSubstr("no file")));
  std::filesystem::remove(folder.file("b.png"));
  ASSERT_EQ(mkfifo(folder.file("b.png").c_str(), 0600), 0);
  EXPECT_THAT(opening(), AllOf(HasSubstr("b.png"), HasSubstr("no file")));
}

TEST(PictureFolder, NamesAPictureThatIsDamaged) {
  const TemporaryFolder folder;
  write_image(folder.file("1.png"), plain(50));
  write_text(folder.file("2.png"), "damaged");
  const auto camera = open_camera("frames", folder.path());
  EXPECT_TRUE(camera->next(0));
  EXPECT_THAT(message_of([&] { camera->next(0); }), HasSubstr("2.png"));
}

TEST(PictureFolder, RefusesAFolderWithoutPictures) {
  const TemporaryFolder folder;
  const auto opening = [&](const std::string& what) {
    return message_of([&] { open_camera("frames", what); });
  };
  EXPECT_THAT(opening(folder.path()), HasSubstr("no pictures"));
  EXPECT_THAT(opening(folder.file("none")), HasSubstr("cannot be read as a folder"));
}

TEST(VideoFile, GivesEveryPictureAtItsTime) {
  const TemporaryFolder folder;
  const std::string path = folder.file("film.avi");
  {
    const auto writer =
        codecs().writer(path, cv::CAP_OPENCV_MJPEG, four_cc({'M', 'J', 'P', 'G'}), 20, 64, 48);
    for (int i = 0; i < 6; ++i) writer->write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i)));
  }
  const auto camera = open_camera("video", path);
  EXPECT_EQ(camera->mode().width_px, 64);
  EXPECT_NEAR(camera->mode().rate_hz, 20, 1e-6);
  int n = 0;
  while (!camera->ended()) {
    const auto picture = camera->next(0);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->number, n);
    EXPECT_NEAR(picture->capture_s, n / 20.0, 1e-3);
    EXPECT_NEAR(picture->image.pixels[0], 40 * n, 3);
    ++n;
  }
  EXPECT_EQ(n, 6);
  EXPECT_FALSE(camera->next(0));
}

TEST(VideoFile, SaysWhatIsNoVideo) {
  const TemporaryFolder folder;
  write_text(folder.file("text.avi"), "no video");
  const auto opening = [&](const std::string& name) {
    return message_of([&] { open_camera("video", folder.file(name)); });
  };
  EXPECT_THAT(opening("none.avi"), HasSubstr("there is no video"));
  EXPECT_THAT(opening("text.avi"), AllOf(HasSubstr("text.avi"), HasSubstr("Motion-JPEG")));
}

TEST(CameraTable, UnknownAndUnfinishedNamesAreUsageErrors) {
  for (const auto& [name, what] :
       {std::pair{"webcam", "0"}, {"camera", ""}, {"frames", ""}, {"video", ""}, {"", ""}}) {
    try {
      open_camera(name, what);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::usage) << error.what();
    }
  }
}

TEST(CameraTable, ACameraThatIsNotThereIsAMissingDevice) {
  try {
    open_camera("camera", "9731");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::device_missing) << error.what();
    EXPECT_THAT(error.what(), HasSubstr("/dev/video9731"));
  }
}

}  // namespace
}  // namespace heft
