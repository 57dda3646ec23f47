// Cells of CSV files: quotes, and texts that a spreadsheet would run.
#include "base/Csv.h"

#include <gtest/gtest.h>

namespace heft {
namespace {

TEST(Csv, CellsAreQuotedWhereTheyNeedIt) {
  EXPECT_EQ(csv_cell("15 g"), "15 g");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"so\""), "\"say \"\"so\"\"\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

TEST(Csv, WhatWouldBeAFormulaIsAText) {
  for (const char* text : {"=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", "\x7f", "'=1"})
    EXPECT_EQ(without_formula(text), std::string("'") + text);
  for (const char* text : {"", "a=b", "1-2", "über", " =1"}) EXPECT_EQ(without_formula(text), text);
}

}  // namespace
}  // namespace heft
