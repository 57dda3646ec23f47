// The shipped protocols, and the recognition of files.
#include <gtest/gtest.h>

#include <filesystem>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

TEST(Shipped, EveryProtocolIsValid) {
  int n = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() + "/protocols")) {
    if (entry.path().extension() != ".toml") continue;  // folders, README.md
    EXPECT_NO_THROW(load_protocol(entry.path().string())) << entry.path();
    ++n;
  }
  EXPECT_EQ(static_cast<std::size_t>(n), shipped_protocols().size());
}

TEST(Shipped, EveryProtocolIsRecognized) {
  for (const std::string& name : shipped_protocols())
    EXPECT_EQ(recognized_kind(content_of(shipped_path(name)), name), FileKind::protocol);
}

TEST(FileKind, IsRecognizedByTheTablesOfAFile) {
  const auto kind = [](const std::string& text) { return recognized_kind(text, "f"); };
  EXPECT_EQ(kind("seed = 1\n[[staircase]]\nname = \"a\"\n"), FileKind::procedure);
  EXPECT_EQ(kind("[effector]\n[coupling]\n[[cube]]\n"), FileKind::scene);
  EXPECT_EQ(kind("[coupling]\ncondition = \"C1\"\n"), FileKind::scene);
  EXPECT_EQ(kind("title = \"t\"\n[coupling]\n"), FileKind::protocol);
  EXPECT_EQ(kind("seed = 1\ninterleave = \"random\"\n[[block]]\n"), FileKind::protocol);
  EXPECT_THROW(kind("colour = \"red\"\n"), InvalidFile);
  EXPECT_THROW(kind(""), InvalidFile);
}

}  // namespace
}  // namespace heft
