// [analysis] and [exclusion] of protocols.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "base/Error.h"
#include "protocol/Protocol.h"
#include "protocol/study/AnalysisPlan.h"

namespace heft {
namespace {

Protocol with(const std::string& tables) {
  return parse_protocol(content_of(shipped_path("quick")) + tables, "x.toml");
}

TEST(AnalysisPlan, DeclaresAndExcludesNothingByDefault) {
  const Protocol protocol = with("");
  EXPECT_FALSE(protocol.analysis.declares_any());
  EXPECT_EQ(protocol.analysis.equivalence_margin, 10);
  EXPECT_FALSE(protocol.exclusion.any());
}

TEST(AnalysisPlan, IsReadAndHashed) {
  const std::string tables =
      "\n[analysis]\nE1-H1 = true\nE2-H1 = true\nequivalence_margin = 5\n"
      "[exclusion]\nunfinished = true\nfalse_alarms = 0.5\n";
  const Protocol protocol = with(tables);
  EXPECT_TRUE(protocol.analysis.declares("E1-H1"));
  EXPECT_FALSE(protocol.analysis.declares("E1-H2"));
  EXPECT_EQ(protocol.analysis.equivalence_margin, 5);
  EXPECT_TRUE(protocol.exclusion.unfinished);
  EXPECT_EQ(protocol.exclusion.false_alarms, 0.5);
  EXPECT_FALSE(protocol.exclusion.out_of_view.has_value());
  EXPECT_NE(protocol.sha256, with("").sha256);
}

TEST(AnalysisPlan, RefusesUnknownHypothesesAndFractionsAboveOne) {
  EXPECT_THROW(with("\n[analysis]\nE3-H1 = true\n"), InvalidFile);
  EXPECT_THROW(with("\n[exclusion]\nfalse_alarms = 1.5\n"), InvalidFile);
}

}  // namespace
}  // namespace heft
