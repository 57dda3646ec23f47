// Texts in gnuplot's scripts.
#include <gtest/gtest.h>

#include "analysis/charts/Plot.h"

namespace heft {
namespace {

TEST(GnuplotQuoted, KeepsQuotesAndMovesOneThatWouldEndTheText) {
  EXPECT_EQ(gnuplot_quoted("heft analyse"), "'heft analyse'");
  EXPECT_EQ(gnuplot_quoted("it's"), "'it''s'");
  EXPECT_EQ(gnuplot_quoted("'a b.db'"), "' ''a b.db'''");
}

}  // namespace
}  // namespace heft
