// Texts of a configuration's values, for the command line and the log.
#include <gtest/gtest.h>

#include "experiment/SessionConfig.h"

namespace heft {
namespace {

template <typename Value>
void expect_both_ways(const char* text, const Value& value) {
  Value read{};
  EXPECT_TRUE(from_text(text, read)) << text;
  EXPECT_EQ(read, value) << text;
  EXPECT_EQ(to_text(value), text);
}

TEST(SessionConfig, ValuesConvertToTextAndBack) {
  expect_both_ways("hand", Plug{"hand"});
  expect_both_ways("video:/a/b:c.avi", Plug{"video", "/a/b:c.avi"});
  expect_both_ways("human", ResponderChoice(Person{}));
  expect_both_ways("coin:/p.toml", ResponderChoice(Plug{"coin", "/p.toml"}));
  expect_both_ways("1", std::optional(NamedDisplay{1}));
  expect_both_ways("0 DELL U2412", std::optional(NamedDisplay{0, "DELL U2412"}));
  expect_both_ways("", std::optional<NamedDisplay>());
  expect_both_ways("yes", std::optional(TakesKeys::yes));
  expect_both_ways("", std::optional<TakesKeys>());
  expect_both_ways("a.b=[1, 2]", ProtocolSetting{"a.b", "[1, 2]"});
  expect_both_ways("a=x=y", ProtocolSetting{"a", "x=y"});
  expect_both_ways("a=1\nb=2", std::vector<ProtocolSetting>{{"a", "1"}, {"b", "2"}});
  expect_both_ways("", std::vector<ProtocolSetting>());
}

TEST(SessionConfig, InvalidTextIsRefused) {
  std::optional<NamedDisplay> display;
  for (const char* text : {"left", "-1", "1x", "999"}) EXPECT_FALSE(from_text(text, display));
  std::optional<TakesKeys> keys;
  EXPECT_FALSE(from_text("maybe", keys));
  ProtocolSetting setting;
  EXPECT_FALSE(from_text("nonsense", setting));
  std::vector<ProtocolSetting> settings;
  EXPECT_FALSE(from_text("a=1\nnonsense", settings));
}

TEST(SessionConfig, PlugKeepsContentsOfItsFile) {
  ResponderChoice responder = Plug{"coin", "/p.toml", "p = 0.5"};
  EXPECT_TRUE(from_text("coin:/p.toml", responder));
  EXPECT_EQ(std::get<Plug>(responder).text, "p = 0.5");
}

}  // namespace
}  // namespace heft
