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

// Otherwise gnuplot would print a warning.
TEST(PlotPanel, OfOneValueHasARangeAroundIt) {
  const auto script_of = [](const std::string& rows) {
    PlotPanel panel;
    panel.add(rows, "using 1:2:3:4 with yerrorbars");
    Chart chart;
    put_script(chart, Summary{}, {}, {panel, PlotPanel{}});
    return chart.script;
  };
  const std::string one = script_of("0 600 600 600\n1 600 600 600\n");
  EXPECT_NE(one.find("set yrange [594:606]\n"), std::string::npos);
  EXPECT_NE(one.find("set autoscale y\n"), std::string::npos) << "the next panel has its own";
  EXPECT_EQ(script_of("0 600 590 610\n").find("set yrange [59"), std::string::npos);
}

}  // namespace
}  // namespace heft
