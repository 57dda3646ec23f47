// Study plans: their files, and the places that they assign to participants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "SourceFolder.h"
#include "base/Error.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "protocol/study/StudyPlan.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

const std::string protocols = source_folder() + "/protocols/";

// A study of paper.toml in a folder that does not exist.
std::string study(const std::string& more, const std::string& protocol = protocols + "paper.toml") {
  return "study = \"mass\"\nparticipants = 12\nseed = 3\nprotocol = \"" + protocol + "\"\n" + more;
}

const std::string two_blocks = "[order]\nblocks = [\"sorting\", \"comparison\"]\n";

std::string mistakes_in(const std::string& text) {
  try {
    parse_study(text, "lab/STUDY.toml");
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names(std::size_t n) {
  std::vector<std::string> blocks;
  for (std::size_t i = 0; i < n; ++i) blocks.push_back(std::string(1, static_cast<char>('a' + i)));
  return blocks;
}

TEST(Study, PathsAreRelativeToItsFile) {
  const StudyPlan plan = parse_study(
      study("db = \"logs/mass.db\"\nbackup = \"/media/stick\"\ndisplay_file = \"../d.toml\"\n"),
      "lab/STUDY.toml");
  EXPECT_EQ(plan.db, "lab/logs/mass.db");
  EXPECT_EQ(plan.backup, "/media/stick");
  EXPECT_EQ(plan.display_file, "d.toml");
  EXPECT_EQ(plan.sha256.size(), 64u);
}

TEST(Study, IsRecognizedAmongFiles) {
  EXPECT_EQ(recognized_kind(study("language = \"fr\"\n"), "f"), FileKind::study);
}

TEST(Study, WithoutGroupsAndOrdersHasTheProtocolsOrder) {
  const StudyPlan plan = parse_study(study(""), "lab/STUDY.toml");
  EXPECT_EQ(plan.groups.size(), 1u);
  EXPECT_EQ(order_setting(plan.orders.at(static_cast<std::size_t>(place_in(plan, 5).order))),
            ProtocolSetting{});
  EXPECT_EQ(planned_id(plan, 5), "05");
}

TEST(Study, ItsProtocolTakesTheOrder) {
  const StudyPlan plan = parse_study(study(two_blocks), "lab/STUDY.toml");
  for (const BlockOrder& order : plan.orders) {
    const Protocol protocol =
        load_protocol(protocols + "paper.toml", std::vector<ProtocolSetting>{order_setting(order)});
    BlockOrder found;
    for (const Block& block : protocol.blocks) {
      const std::string name = block_name(block);
      if (std::ranges::count(order, name) > 0) found.push_back(name);
    }
    EXPECT_EQ(found, order);
    EXPECT_TRUE(std::holds_alternative<DemonstrationBlock>(protocol.blocks.front()));
  }
}

TEST(Study, NamesOfBlocksAreQuotedInSettings) {
  EXPECT_EQ(to_text(order_setting({"a\"b", "c\\\n"})),
            "block_order=[\"a\\\"b\", \"c\\\\\\u000A\"]");
}

TEST(StudyOrders, OfALatinSquareHaveEachBlockOnceInEachPosition) {
  for (std::size_t n = 2; n <= 7; ++n) {
    const auto orders = designed_orders(OrderDesign::latin, names(n), n);
    ASSERT_EQ(orders.size(), n);
    for (std::size_t place = 0; place < n; ++place) {
      std::set<std::string> there;
      for (const BlockOrder& order : orders) there.insert(order[place]);
      EXPECT_EQ(there.size(), n);
    }
  }
}

TEST(StudyOrders, BalancedOrdersHaveEachBlockEquallyOftenAfterEachOther) {
  for (std::size_t n = 2; n <= 7; ++n) {
    const auto orders = designed_orders(OrderDesign::balanced, names(n), 11);
    EXPECT_EQ(orders.size(), n % 2 == 0 ? n : 2 * n);
    std::map<std::pair<std::string, std::string>, int> after;
    for (const BlockOrder& order : orders) {
      EXPECT_TRUE(std::ranges::is_permutation(order, names(n)));
      for (std::size_t i = 1; i < n; ++i) ++after[{order[i - 1], order[i]}];
    }
    EXPECT_EQ(after.size(), n * (n - 1));
    for (const auto& [pair, times] : after) EXPECT_EQ(times, n % 2 == 0 ? 1 : 2);
  }
}

StudyPlan three_groups_of_four_orders() {
  StudyPlan plan;
  plan.participants = 36;
  plan.seed = 5;
  plan.groups.resize(3);
  plan.orders = designed_orders(OrderDesign::latin, names(4), plan.seed);
  return plan;
}

TEST(StudyPlaces, OfARoundHaveEachGroupWithEachOrderOnce) {
  const StudyPlan plan = three_groups_of_four_orders();
  for (int round = 0; round < 3; ++round) {
    std::set<std::pair<int, int>> given;
    for (int i = 1; i <= 12; ++i) {
      const StudyPlace place = place_in(plan, 12 * round + i);
      EXPECT_EQ(place.number, 12 * round + i);
      given.insert({place.group, place.order});
    }
    EXPECT_EQ(given.size(), 12u);
  }
}

TEST(StudyPlaces, AreBalancedOverGroupsAtAnyTime) {
  const StudyPlan plan = three_groups_of_four_orders();
  std::map<int, int> people;
  for (int number = 1; number <= 36; ++number) {
    ++people[place_in(plan, number).group];
    if (number % 3 != 0) continue;
    for (const auto& [group, n] : people) EXPECT_EQ(n, number / 3);
  }
}

TEST(StudyPlaces, DoNotChangeWithMoreParticipants) {
  StudyPlan plan = three_groups_of_four_orders();
  StudyPlan larger = plan;
  larger.participants = 100;
  for (int number = 1; number <= plan.participants; ++number) {
    EXPECT_EQ(place_in(plan, number).group, place_in(larger, number).group);
    EXPECT_EQ(place_in(plan, number).order, place_in(larger, number).order);
  }
}

TEST(StudyPlaces, DependOnTheSeed) {
  StudyPlan plan = three_groups_of_four_orders();
  StudyPlan other = plan;
  other.seed = 6;
  int n_same = 0;
  for (int i = 1; i <= 36; ++i) n_same += place_in(plan, i).order == place_in(other, i).order;
  EXPECT_LT(n_same, 30);
}

TEST(BrokenStudy, IsRefusedAtItsPlace) {
  EXPECT_THAT(mistakes_in("study = \"m\"\nparticipants = 0\nprotocol = \"x.toml\"\n"),
              HasSubstr("lab/STUDY.toml:2:16: participants"));
  EXPECT_THAT(mistakes_in("participants = 3\n"), HasSubstr("lacks \"study\""));
  EXPECT_THAT(mistakes_in("study = \"m\"\nparticipants = 3\n"), HasSubstr("lacks \"protocol\""));
  EXPECT_THAT(mistakes_in(study("seeed = 4\n")),
              HasSubstr("STUDY.toml:5:1: unknown key \"seeed\""));
  EXPECT_THAT(mistakes_in(study("[order]\ndesign = \"latn\"\n")),
              HasSubstr("did you mean \"latin\"?"));
  EXPECT_THAT(mistakes_in(study("[order]\nblocks = [\"sorting\", 3]\n")),
              HasSubstr("STUDY.toml:6:22: "));
  EXPECT_THAT(mistakes_in(study("[order]\nblocks = [\"comparison\", \"comparison\"]\n")),
              HasSubstr("STUDY.toml:6:25: \"comparison\" is listed twice"));
  EXPECT_THAT(mistakes_in(study("[order]\nblocks = [\"comparison\"]\n")), HasSubstr("has 1 block"));
  EXPECT_THAT(mistakes_in(study("[[group]]\nname = \"a\"\n[[group]]\nname = \"a\"\n")),
              HasSubstr("STUDY.toml:8:8: another group is named \"a\""));
}

TEST(BrokenStudy, InvalidIdsAreRefused) {
  EXPECT_THAT(mistakes_in(study("id_prefix = \"P\\u0007\"\n")),
              HasSubstr("lab/STUDY.toml:5:13: id_prefix is \"P \", expected a text on one line, "
                        "without control characters"));
  EXPECT_THAT(mistakes_in(study("id_prefix = \"" + std::string(199, 'x') + "\"\n")),
              HasSubstr("has 201 bytes"));
  EXPECT_THAT(mistakes_in(study("id_prefix = \" P\"\n")), HasSubstr("begins with a blank"));
  EXPECT_EQ(mistakes_in(study("id_prefix = \"Gruppe Ä \"\n")), "");
}

TEST(BrokenStudy, BlocksThatItsProtocolLacksAreNamed) {
  EXPECT_THAT(mistakes_in(study("[order]\nblocks = [\"sorting\", \"comparisn\"]\n")),
              HasSubstr("STUDY.toml:6:22: "));
  EXPECT_THAT(
      mistakes_in(study("[order]\ndesign = \"rows\"\n[[order.row]]\nblocks = [\"sorting\", "
                        "\"comparison\"]\n[[order.row]]\nblocks = [\"sorting\", \"sorting2\"]\n")),
      HasSubstr("STUDY.toml:10:10: blocks differ from those of the first row"));
}

TEST(BrokenStudy, AnUnreadableProtocolIsReportedAtItsPlace) {
  EXPECT_THAT(mistakes_in(study("", "none.toml")), HasSubstr("lab/STUDY.toml:4:12: "));
  EXPECT_THAT(mistakes_in(study("", "none.toml")), HasSubstr("lab/none.toml"));
  EXPECT_THAT(mistakes_in(study("", protocols + "apparatus/board.toml")),
              HasSubstr("this protocol is not valid: "));
}

TEST(BlockOrder, OfAProtocolNamesItsBlocks) {
  const auto refused = [](const std::string& order) -> std::string {
    try {
      load_protocol(protocols + "paper.toml", std::vector<ProtocolSetting>{{"block_order", order}});
    } catch (const InvalidFile& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refused("[\"nothing\", \"comparison\"]"), HasSubstr("there is no block \"nothing\""));
  EXPECT_THAT(refused("[\"comparison\", \"comparison\"]"), HasSubstr("is listed twice"));
  EXPECT_THAT(refused("[]"), HasSubstr("block_order"));
}

}  // namespace
}  // namespace heft
