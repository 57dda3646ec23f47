// Comma-separated text, well-formed and malformed.
#include "base/files/Csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace heft {
namespace {

using testing::ElementsAre;
using Texts = std::vector<std::string>;

std::vector<Texts> texts_of(const std::string& text) {
  CsvReader reader(text, "file.csv");
  std::vector<Texts> rows;
  for (auto row = reader.next(); !row.empty(); row = reader.next()) {
    rows.emplace_back();
    for (const CsvCell& cell : row) rows.back().push_back(cell.text);
  }
  return rows;
}

TEST(Csv, RowsOfCells) {
  EXPECT_THAT(texts_of("a,b\n1, 2 \n"), ElementsAre(Texts{"a", "b"}, Texts{"1", "2"}));
  EXPECT_THAT(texts_of("\xEF\xBB\xBF"
                       "a,b\r\n1,2\r\n"),
              ElementsAre(Texts{"a", "b"}, Texts{"1", "2"}));
  EXPECT_THAT(texts_of("a,b\n1,2"), ElementsAre(Texts{"a", "b"}, Texts{"1", "2"}));
  EXPECT_THAT(texts_of("a,\n,\n"), ElementsAre(Texts{"a", ""}, Texts{"", ""}));
  EXPECT_THAT(texts_of("1,"), ElementsAre(Texts{"1", ""}));
}

TEST(Csv, BlankLinesArePassedOver) {
  EXPECT_THAT(texts_of("\n \na\n\r\n\nb\n\n"), ElementsAre(Texts{"a"}, Texts{"b"}));
  EXPECT_TRUE(texts_of("").empty());
  EXPECT_TRUE(texts_of("\n\r\n").empty());
}

TEST(Csv, QuotedCells) {
  EXPECT_THAT(texts_of(R"("a, b" , "say ""no""",c"d)"
                       "\n"),
              ElementsAre(Texts{"a, b", "say \"no\"", "c\"d"}));
  EXPECT_THAT(texts_of("\"two\nlines\",x\r\ny,\" z \"\r\n"),
              ElementsAre(Texts{"two\nlines", "x"}, Texts{"y", " z "}));
}

TEST(Csv, ACellKnowsItsPlace) {
  CsvReader reader("a,\"b\n\",c\n  d,e", "file.csv");
  const auto first = reader.next(), second = reader.next();
  EXPECT_EQ(to_string(reader.mistake(first[1], "").place), "file.csv:1:3");
  EXPECT_EQ(to_string(reader.mistake(first[2], "").place), "file.csv:2:3");
  EXPECT_EQ(to_string(reader.mistake(second[0], "").place), "file.csv:3:3");
  EXPECT_EQ(to_string(reader.mistake(second[1], "").place), "file.csv:3:5");
}

std::string refusal_of(const std::string& text) {
  try {
    texts_of(text);
  } catch (const InvalidFile& error) {
    return to_string(error.mistakes().at(0).place);
  }
  return "none";
}

TEST(Csv, QuotesThatGoWrongAreRefusedInTheirPlace) {
  EXPECT_EQ(refusal_of("a\nb,\"c\nd"), "file.csv:2:3");
  EXPECT_EQ(refusal_of("a\n\"b\" c,d\n"), "file.csv:2:5");
  EXPECT_EQ(refusal_of("\""), "file.csv:1:1");
}

std::string quoted(const std::string& cell) {
  std::string text = "\"";
  for (char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

RC_GTEST_PROP(Csv, WhatIsWrittenInQuotesIsRead, ()) {
  const auto cell =
      rc::gen::container<std::string>(rc::gen::element('a', '"', ',', '\n', '\r', ' ', '\t'));
  const auto rows = *rc::gen::nonEmpty(
      rc::gen::container<std::vector<Texts>>(rc::gen::container<Texts>(2, cell)));
  std::string text;
  for (const Texts& row : rows) text += quoted(row[0]) + "," + quoted(row[1]) + "\n";
  RC_ASSERT(texts_of(text) == rows);
}

RC_GTEST_PROP(Csv, AnyTextIsReadToItsEndOrRefused, ()) {
  const auto text = *rc::gen::container<std::string>(
      rc::gen::oneOf(rc::gen::element(',', '"', '\n', '\r', ' ', 'x'), rc::gen::arbitrary<char>()));
  try {
    CsvReader reader(text, "file.csv");
    for (auto row = reader.next(); !row.empty(); row = reader.next())
      for (const CsvCell& cell : row) RC_ASSERT(cell.line >= 1 && cell.column >= 1);
  } catch (const InvalidFile& error) {
    RC_ASSERT(error.mistakes().size() == 1u);
  }
}

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
