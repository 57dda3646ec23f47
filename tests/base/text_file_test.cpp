// Replacing a file keeps the old one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/temporary_folder.h"

namespace heft {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

TEST(ReplaceTextFile, KeepsEveryEarlierOneBesideIt) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("camera.yaml");
  EXPECT_EQ(replace_text_file(path, "first"), "");
  EXPECT_EQ(replace_text_file(path, "second"), path + ".before");
  EXPECT_EQ(replace_text_file(path, "third"), path + ".before2");
  EXPECT_EQ(read_text_file(path), "third");
  EXPECT_EQ(read_text_file(path + ".before"), "first");
  EXPECT_EQ(read_text_file(path + ".before2"), "second");
  EXPECT_THAT(files_in(folder.path()),
              ElementsAre("camera.yaml", "camera.yaml.before", "camera.yaml.before2"));
}

TEST(ReplaceTextFile, GoesThroughASymbolicLink) {
  const test::TemporaryFolder folder;
  replace_text_file(folder.file("real"), "old");
  fs::create_symlink("real", folder.file("link"));
  replace_text_file(folder.file("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("link")));
  EXPECT_EQ(read_text_file(folder.file("real")), "new");
  EXPECT_EQ(read_text_file(folder.file("real.before")), "old");
}

std::string refusal(const std::string& path) {
  try {
    require_writable(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "writable";
}

TEST(RequireWritable, SaysWhatIsWrongBeforeTheWork) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(refusal(folder.file("new.yaml")), "writable");
  EXPECT_EQ(refusal("in_this_folder.yaml"), "writable");
  EXPECT_THAT(files_in(folder.path()), ElementsAre());  // asking leaves nothing behind
  EXPECT_THAT(refusal(folder.file("missing/camera.yaml")),
              HasSubstr("check that its folder exists"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("a device"));
}

TEST(ReadTextFile, NeverWaitsForAPipe) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  for (const std::string& path : {folder.file("pipe"), std::string("/dev/zero")}) try {
      read_text_file(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("a device or a pipe, expected a file"));
    }
}

TEST(CreateFile, WritesOverNothingAndFollowsNoLink) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("new");
  EXPECT_TRUE(create_file(path, 0600));
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  replace_text_file(path, "kept");
  EXPECT_FALSE(create_file(path, 0600));
  EXPECT_EQ(read_text_file(path), "kept");
  fs::create_symlink("nowhere", folder.file("link"));
  EXPECT_FALSE(create_file(folder.file("link"), 0600));
  EXPECT_FALSE(fs::exists(folder.file("nowhere")));
  EXPECT_THROW(create_file(folder.file("no/such/file"), 0600), Error);
}

TEST(TextFile, HugeFilesAreRefusedUnread) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("huge.toml");
  std::ofstream(path) << "a";
  std::filesystem::resize_file(path, 10'000'000'000);  // sparse
  try {
    read_text_file(path);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 fmt::format("can't read {}: it has 9536 MB, expected at most 256", path).c_str());
  }
}

}  // namespace
}  // namespace heft
