// Tables as text, CSV and HTML.
#include "analysis/display/Table.h"

#include <gmock/gmock.h>

#include <limits>

#include "analysis/display/EstimateTable.h"
#include "analysis/display/Phrases.h"

namespace heft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

Table small_table() {
  return {"small",
          "A title",
          {{"name", "name"}, {"value_g", "value g"}, {"hidden", ""}},
          {{word("é, \"x\""), number(1.0 / 3), count(7)}, {word("b"), number({}), count(8)}},
          "a note"};
}

TEST(Table, TextIsAlignedByCharactersNotBytes) {
  EXPECT_EQ(as_text(small_table()),
            "A title\n"
            "  name    value g\n"
            "  é, \"x\"      0.3\n"
            "  b             -\n"
            "  a note\n");
}

TEST(Table, CsvIsUnroundedQuotedAndSaysWhoseFigures) {
  EXPECT_EQ(as_csv(small_table(), "simulated"),
            "data,name,value_g,hidden\n"
            "simulated,\"é, \"\"x\"\"\",0.3333333333333333,7\n"
            "simulated,b,,8\n");
}

TEST(Table, NoCellIsAFormulaOrATerminalsCommand) {
  Table table = small_table();
  table.rows[0][0].text = "=1+1";
  table.rows[1][0].text = "-2";
  EXPECT_THAT(as_csv(table, ""), AllOf(HasSubstr(",'=1+1,"), HasSubstr(",'-2,")));
  EXPECT_EQ(html_escaped("a\x1b[2J\nb"), "a\uFFFD[2J\nb");
}

TEST(Table, HtmlIsEscapedAndWithoutCsvOnlyColumns) {
  const std::string html = as_html(small_table());
  EXPECT_THAT(html, HasSubstr("<td>é, &quot;x&quot;</td><td class=\"n\">0.3</td></tr>"));
  EXPECT_EQ(html_escaped("<a & b>"), "&lt;a &amp; b&gt;");
}

TEST(Table, WhatIsNotFiniteDoesNotExist) {
  EXPECT_TRUE(number(std::numeric_limits<double>::quiet_NaN()).text.empty());
  EXPECT_FALSE(number(std::numeric_limits<double>::infinity()).value.has_value());
}

TEST(Digits, AreNoMoreThanDataSupport) {
  EXPECT_EQ(in_grams(7.6), "8");
  EXPECT_EQ(in_grams(999.4), "999");
  EXPECT_EQ(in_grams(1570.7), "1570");
  EXPECT_EQ(in_grams(37817.8), "37800");
  static constexpr Measure jnd{"jnd", "g", "JND", ""};
  StudyEstimate estimate{&jnd};
  estimate.value = 999.26;
  estimate.high = 37817.76;
  EXPECT_EQ(grams_between(estimate), "") << "the interval has one end";
  const Table table =
      table_of({"t", "", {column(jnd, Field::value, "g"), column(jnd, Field::high, "high")}, ""},
               {estimate});
  EXPECT_EQ(table.rows.at(0).at(0).text, "999.3");
  EXPECT_EQ(table.rows.at(0).at(1).text, "37818");
  EXPECT_EQ(table.rows.at(0).at(1).value, 37817.76) << "files have all digits";
}

TEST(Wrapping, BreaksAtSpacesAndLongWords) {
  EXPECT_THAT(wrapped("one two three", 8), ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("abcdefgh", 3), ElementsAre("abc", "def", "gh"));
  EXPECT_THAT(wrapped("", 3), SizeIs(0));
}

}  // namespace
}  // namespace heft
