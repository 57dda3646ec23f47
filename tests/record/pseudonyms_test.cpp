#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "base/Error.h"
#include "record/export/Export.h"

namespace heft {
namespace {
namespace fs = std::filesystem;

TEST(Pseudonyms, HmacMatchesRfc4231) {
  EXPECT_EQ(hmac_sha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'),
                        "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST(Pseudonyms, DependOnKey) {
  EXPECT_EQ(pseudonym("key", "01"), pseudonym("key", "01"));
  EXPECT_NE(pseudonym("key", "01"), pseudonym("key", "02"));
  EXPECT_NE(pseudonym("key", "01"), pseudonym("other", "01"));
  EXPECT_THAT(pseudonym("key", "01"), testing::MatchesRegex("p[0-9a-f]{12}"));
}

TEST(Pseudonyms, KeyIsCreatedForOwnerAndReadAgain) {
  const fs::path file = fs::path(testing::TempDir()) / "heft_pseudonyms.key";
  fs::remove(file);
  const PseudonymKey made = pseudonym_key(file);
  EXPECT_TRUE(made.is_new);
  EXPECT_EQ(made.key.size(), 64u);
  struct stat found {};
  ASSERT_EQ(stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777u, 0600u);
  const PseudonymKey again = pseudonym_key(file);
  EXPECT_FALSE(again.is_new);
  EXPECT_EQ(again.key, made.key);
  fs::remove(file);
}

std::string why_refused(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "heft_given.key";
  std::ofstream(file, std::ios::binary) << text;
  std::string why;
  try {
    pseudonym_key(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::invalid_file);
    why = error.what();
  }
  fs::remove(file);
  return why;
}

TEST(Pseudonyms, NonRandomKeyIsRefused) {
  const std::string drawn = "6c1f0b94d2e87a35f01b9c64de27538a4f6e1d0b92c8a7356be40f18d2937c5a";
  EXPECT_EQ(why_refused(drawn), "");
  EXPECT_EQ(why_refused(drawn + "\n"), "");
  EXPECT_THAT(why_refused("short\n"), testing::HasSubstr("no key"));
  EXPECT_THAT(why_refused(""), testing::HasSubstr("a key of 0 digits"));
  EXPECT_THAT(why_refused(std::string(32, '\0')), testing::HasSubstr("openssl rand -hex 32"));
  EXPECT_THAT(why_refused(std::string(64, '0')), testing::HasSubstr("1 different digits"));
  EXPECT_THAT(why_refused(drawn.substr(1)), testing::HasSubstr("63 digits"));
  EXPECT_THAT(why_refused(drawn + "\n" + drawn), testing::HasSubstr("no key"));
  EXPECT_THAT(why_refused("participant,age\n01,30\n02,31\n03,29\n"), testing::HasSubstr("no key"));
}

}  // namespace
}  // namespace heft
