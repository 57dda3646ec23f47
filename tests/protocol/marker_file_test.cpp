// Board and effector files: positions of tags, and each mistake at its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "protocol/readers/Files.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {
namespace {

const std::string board_grid = R"(family = "tag36h11"
[grid]
columns = 6
rows = 4
tag_m = 0.040
pitch_m = 0.048
first_id = 7
)";

const std::string board_tags = R"(family = "tag25h9"
ruler_measured_m = 0.15
[[tag]]
id = 3
corners_m = [[-0.02, 0.02, 0], [0.02, 0.02, 0], [0.02, -0.02, 0], [-0.02, -0.02, 0]]
[[tag]]
id = 34
corners_m = [[0.03, 0.02, 0.01], [0.07, 0.02, 0.01], [0.07, -0.02, 0.01], [0.03, -0.02, 0.01]]
)";

const std::string effector_box = R"(family = "tag36h11"
size_m = [0.090, 0.040, 0.036]
[box]
tag_m = 0.024
tip_margin_m = 0.005
tip = 30
top = 31
left = 32
right = 33
bottom = 34
)";

// On the top face, the tag's upper side is towards the tip.
const std::string effector_tags = R"(size_m = [0.090, 0.040, 0.040]
[[tag]]
id = 8
corners_m = [[0.04, 0.01, 0.02], [0.04, -0.01, 0.02], [0.02, -0.01, 0.02], [0.02, 0.01, 0.02]]
)";

void expect_near(const Eigen::Vector3d& found, double x, double y, double z) {
  EXPECT_LT((found - Eigen::Vector3d(x, y, z)).norm(), 1e-12) << found.transpose();
}

TEST(BoardFile, GridIsRowMajorFromTheFarLeft) {
  const MarkerBody board = parse_board(board_grid, "x.toml");
  ASSERT_EQ(board.tags.size(), 24u);
  EXPECT_EQ(board.family, "tag36h11");
  EXPECT_TRUE(board.size_m.isZero());
  const Tag &first = board.tags.front(), &second = board.tags[1], &last = board.tags.back();
  EXPECT_EQ(first.id, 7);
  EXPECT_EQ(last.id, 30);
  expect_near(first.corners_m[0], -0.140, 0.092, 0);
  expect_near(first.corners_m[1], -0.100, 0.092, 0);
  expect_near(first.corners_m[2], -0.100, 0.052, 0);
  expect_near(first.corners_m[3], -0.140, 0.052, 0);
  expect_near(second.corners_m[0], -0.092, 0.092, 0);
  expect_near(last.corners_m[2], 0.140, -0.092, 0);
}

TEST(BoardFile, MayPlaceEachTag) {
  const MarkerBody board = parse_board(board_tags, "x.toml");
  ASSERT_EQ(board.tags.size(), 2u);
  EXPECT_EQ(board.family, "tag25h9");
  EXPECT_EQ(board.tags[1].id, 34);
  expect_near(board.tags[1].corners_m[3], 0.03, -0.02, 0.01);
}

TEST(BoardFile, IsScaledByTheMeasuredRuler) {
  const MarkerBody plain = parse_board(board_grid, "x.toml");
  const MarkerBody scaled = parse_board("ruler_measured_m = 0.153\n" + board_grid, "x.toml");
  EXPECT_EQ(plain.measured_ruler_m, std::nullopt);
  EXPECT_EQ(scaled.measured_ruler_m, 0.153);
  for (std::size_t i = 0; i < plain.tags.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_LT((scaled.tags[i].corners_m[c] - 1.02 * plain.tags[i].corners_m[c]).norm(), 1e-12);
}

// Printers scale the two directions differently.
TEST(BoardFile, IsScaledInBothDirectionsByTwoLengths) {
  const MarkerBody plain = parse_board(board_grid, "x.toml");
  const MarkerBody scaled =
      parse_board("ruler_measured_m = [0.153, 0.147]\n" + board_grid, "x.toml");
  EXPECT_EQ(scaled.measured_ruler_m, 0.153);
  EXPECT_EQ(scaled.measured_across_m, 0.147);
  EXPECT_NE(described(scaled).find("ruler measured: 153 x 147 mm"), std::string::npos);
  for (std::size_t i = 0; i < plain.tags.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      const Eigen::Vector3d expected =
          plain.tags[i].corners_m[c].cwiseProduct(Eigen::Vector3d(1.02, 0.98, 1.02));
      EXPECT_LT((scaled.tags[i].corners_m[c] - expected).norm(), 1e-12);
    }
}

// The tip's tag is upright. On long faces, the tag's upper side is towards the tip.
TEST(EffectorFile, BoxHasItsTagsAtTheTip) {
  const MarkerBody effector = parse_effector(effector_box, "x.toml");
  ASSERT_EQ(effector.tags.size(), 5u);
  expect_near(effector.size_m, 0.090, 0.040, 0.036);
  const auto corner = [&](int id, std::size_t c) {
    for (const Tag& tag : effector.tags)
      if (tag.id == id) return tag.corners_m[c];
    return Eigen::Vector3d(1, 1, 1);
  };
  expect_near(corner(30, 0), 0.045, -0.012, 0.012);
  expect_near(corner(30, 1), 0.045, 0.012, 0.012);
  expect_near(corner(31, 0), 0.040, 0.012, 0.018);
  expect_near(corner(31, 2), 0.016, -0.012, 0.018);
  expect_near(corner(32, 0), 0.040, 0.020, -0.012);
  expect_near(corner(33, 0), 0.040, -0.020, 0.012);
  expect_near(corner(34, 0), 0.040, -0.012, -0.018);
}

// Long faces are upright on the sheet: the length of the effector is along the vertical ruler.
TEST(EffectorFile, IsScaledInBothDirectionsByTwoLengths) {
  const MarkerBody plain = parse_effector(effector_box, "x.toml");
  const std::string text = "ruler_measured_m = [0.153, 0.147]\n" + effector_box;
  const MarkerBody scaled = parse_effector(text, "x.toml");
  expect_near(scaled.size_m, 0.98 * 0.090, 1.02 * 0.040, 1.02 * 0.036);
  for (std::size_t i = 0; i < plain.tags.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      const double up = plain.tags[i].id == 30 ? 0.98 : 1.02;  // the tip's tag is upright, too
      const Eigen::Vector3d expected =
          plain.tags[i].corners_m[c].cwiseProduct(Eigen::Vector3d(0.98, 1.02, up));
      EXPECT_LT((scaled.tags[i].corners_m[c] - expected).norm(), 1e-12);
    }
  const MarkerBody again = parse_effector(effector_to_toml(scaled, ""), "y.toml");
  EXPECT_EQ(again.measured_across_m, 0.147);
  EXPECT_LT((again.tags[1].corners_m[2] - scaled.tags[1].corners_m[2]).norm(), 1e-8);
}

const std::string effector_chamfered = R"(size_m = [0.090, 0.085, 0.040]
chamfer_m = 0.025
[box]
tag_m = 0.028
tip_margin_m = 0.004
tip = 40
top = 41
upper_left = 42
upper_right = 43
)";

// The slanted faces between top and sides face up and to the left or right, at 45 degrees.
TEST(EffectorFile, ChamferedBoxHasSlantedFaces) {
  const MarkerBody effector = parse_effector(effector_chamfered, "x.toml");
  ASSERT_EQ(effector.tags.size(), 4u);
  const Tag &left = effector.tags[2], &right = effector.tags[3];
  EXPECT_EQ(left.id, 42);
  const double slant = std::sqrt(0.5);
  expect_near(tag_normal(left), 0, slant, slant);
  expect_near(tag_normal(right), 0, -slant, slant);
  expect_near(tag_center_m(left), 0.027, 0.030, 0.0075);
  expect_near(tag_center_m(right), 0.027, -0.030, 0.0075);
  // Upper sides are towards the tip; the left tag's left side is down.
  expect_near(left.corners_m[0], 0.041, 0.030 + 0.014 * slant, 0.0075 - 0.014 * slant);
  EXPECT_NE(described(effector).find("its upper edges cut by 25 mm"), std::string::npos);
  const MarkerBody again = parse_effector(effector_to_toml(effector, ""), "y.toml");
  EXPECT_NEAR(again.chamfer_m, 0.025, 1e-9);
}

TEST(EffectorFile, FamilyIsUsuallyTag36h11) {
  const MarkerBody effector = parse_effector(effector_tags, "x.toml");
  EXPECT_EQ(effector.family, "tag36h11");
  EXPECT_EQ(effector.tags.size(), 1u);
}

TEST(EffectorFile, IsReadBackAsWritten) {
  const MarkerBody body = parse_effector("ruler_measured_m = 0.1493\n" + effector_box, "x.toml");
  const std::string text = effector_to_toml(body, "from a test\n\nof two lines");
  EXPECT_TRUE(text.starts_with("# from a test\n#\n# of two lines\n"));
  const MarkerBody again = parse_effector(text, "y.toml");
  EXPECT_EQ(again.family, body.family);
  EXPECT_EQ(again.measured_ruler_m, body.measured_ruler_m);
  EXPECT_LT((again.size_m - body.size_m).norm(), 1e-8);
  ASSERT_EQ(again.tags.size(), body.tags.size());
  for (std::size_t i = 0; i < body.tags.size(); ++i) {
    EXPECT_EQ(again.tags[i].id, body.tags[i].id);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_LT((again.tags[i].corners_m[c] - body.tags[i].corners_m[c]).norm(), 1e-8);
  }
}

TEST(MarkerFile, BodiesMustNotShareTags) {
  const MarkerBody board = parse_board(board_grid, "x.toml");  // 7 to 30
  const MarkerBody effector = parse_effector(effector_box, "x.toml");
  try {
    require_different_tags(board, effector);
    FAIL() << "both have tag 30";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("both have tag 30 "), std::string::npos);
  }
  EXPECT_NO_THROW(require_different_tags(parse_board(board_tags, "x.toml"), effector));
}

TEST(MarkerFile, HasADescription) {
  EXPECT_EQ(described(parse_board(board_grid, "x.toml")),
            "24 tags of tag36h11, 40 mm, ids 7-30, over 280 x 184 mm, ruler not measured yet");
  EXPECT_EQ(described(parse_board(board_tags, "x.toml")),
            "2 tags of tag25h9, 40 mm, ids 3, 34, over 90 x 40 mm, ruler measured: 150 mm");
  EXPECT_EQ(described(parse_effector(effector_tags, "x.toml")),
            "1 tag of tag36h11, 20 mm, id 8, a box of 90 x 40 x 40 mm, ruler not measured yet");
}

TEST(MarkerFile, IsRecognized) {
  EXPECT_EQ(recognized_kind(board_grid, "f"), FileKind::board);
  EXPECT_EQ(recognized_kind(board_tags, "f"), FileKind::board);
  EXPECT_EQ(recognized_kind(effector_box, "f"), FileKind::effector);
  EXPECT_EQ(recognized_kind(effector_tags, "f"), FileKind::effector);
}

TEST(Apparatus, ShippedFilesFitEachOther) {
  const std::string folder = source_folder() + "/protocols/apparatus/";
  const MarkerBody board = load_board(folder + "board.toml");
  const MarkerBody effector = load_effector(folder + "effector.toml");
  EXPECT_EQ(board.tags.size(), 24u);
  EXPECT_EQ(effector.tags.size(), 5u);
  EXPECT_NO_THROW(require_different_tags(board, effector));
  EXPECT_EQ(recognized_kind(content_of(folder + "board.toml"), "b"), FileKind::board);
  EXPECT_EQ(recognized_kind(content_of(folder + "effector.toml"), "e"), FileKind::effector);
}

const Broken of_grid[] = {
    {"unknown_family", {"\"tag36h11\"", "^\"tag36h12\""}, {"did you mean \"tag36h1"}},
    {"no_columns", {"[grid]\ncolumns = 6\n", "^[grid]\n"}, {"[grid] lacks \"columns\""}},
    {"no_rows", {"rows = 4", "rows = ^0"}, {"rows is 0", "from 1 to 1000"}},
    {"unknown_key", {"pitch_m", "^pitch"}, {"\"pitch_m\"?"}},
    {"no_white", {"0.048", "^0.044"}, {"expected at least 0.045", "0.005 m of white"}},
    {"code_overlaps",
     {"\"tag36h11\"\n[grid]\ncolumns = 6\nrows = 4\ntag_m = 0.040\npitch_m = 0.048",
      "\"tagStandard41h12\"\n[grid]\ncolumns = 6\nrows = 4\ntag_m = 0.040\npitch_m = ^0.070"},
     {"expected at least 0.072", "0.032 m of code"}},
    {"millimeters", {"0.040", "^40"}, {"tag_m is 40", "at most 2"}},
    {"ids_run_out", {"= 7", "= ^580"}, {"580 to 603", "0 to 586"}},
    {"no_such_first_id", {"= 7", "= ^587"}, {"first_id is 587", "from 0 to 586"}},
    {"one_of_two_rulers_in_millimeters",
     {"[grid]", "ruler_measured_m = [0.15, ^149.3]\n[grid]"},
     {"0.12", "0.18"}},
    {"ruler_in_millimeters", {"[grid]", "ruler_measured_m = ^149.3\n[grid]"}, {"0.12", "0.18"}},
    {"no_tags", {board_grid, "^family = \"tag16h5\"\n"}, {"[grid] or [[tag]]"}},
    {"misspelled_grid", {"[grid]", "[^gird]"}, {"\"grid\"?"}},
    {"both_ways",
     {"first_id = 7\n",
      "^[[tag]]\nid = 1\ncorners_m = [[0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 0]]\n"},
     {"[grid] and [[tag]]", "one of them"}},
};

const Broken of_tags[] = {
    {"no_id", {"[[tag]]\nid = 3\n", "^[[tag]]\n"}, {"[[tag]] lacks \"id\""}},
    {"twice", {"= 34", "= ^3"}, {"tag 3 is listed twice"}},
    {"not_in_family", {"= 34", "= ^35"}, {"id is 35", "tag25h9: 0 to 34"}},
    {"three_corners", {"[[-0.02, 0.02, 0], ", "^["}, {"4 points [x, y, z]"}},
    {"flat_corner", {"[-0.02, 0.02, 0]", "^[-0.02, 0.02]"}, {"has 2 numbers, expected 3"}},
    {"corner_of_words", {"-0.02, 0.02", "^\"left\", 0.02"}, {"corners_m is \"left\""}},
    {"infinite", {"-0.02, 0.02", "^inf, 0.02"}, {"a finite number"}},
    {"oblong",
     {"[[-0.02, 0.02, 0], [0.02, 0.02, 0]", "^[[-0.02, 0.03, 0], [0.02, 0.03, 0]"},
     {"tag 3 has sides of 0.04 to 0.05 m"}},
    {"rhombic",
     {"[[-0.02, 0.02, 0], [0.02, 0.02, 0]", "^[[-0.01, 0.0187, 0], [0.03, 0.0187, 0]"},
     {"tag 3 has diagonals"}},
    {"crossed",
     {"[[-0.02, 0.02, 0], [0.02, 0.02, 0], [0.02, -0.02, 0]",
      "^[[-0.02, 0.02, 0], [0.02, -0.02, 0], [0.02, 0.02, 0]"},
     {"tag 3 has sides of"}},
    {"bent", {"[[-0.02, 0.02, 0]", "^[[-0.02, 0.02, 0.008]"}, {"out of place"}},
    {"a_point", {"[[0.03, 0.02, 0.01], [0.07", "^[[0.03, 0.02, 0.01], [0.03"}, {"tag 34"}},
    {"mirrored",
     {"[[-0.02, 0.02, 0], [0.02, 0.02, 0], [0.02, -0.02, 0], [-0.02, -0.02, 0]]",
      "^[[0.02, 0.02, 0], [-0.02, 0.02, 0], [-0.02, -0.02, 0], [0.02, -0.02, 0]]"},
     {"tag 3 faces down", "clockwise as seen from above"}},
    {"in_millimeters",
     {"[[-0.02, 0.02, 0], [0.02, 0.02, 0], [0.02, -0.02, 0], [-0.02, -0.02, 0]]",
      "^[[-20, 20, 0], [20, 20, 0], [20, -20, 0], [-20, -20, 0]]"},
     {"side of 40 m", "millimeters?"}},
};

const Broken of_box[] = {
    {"no_size",
     {"family = \"tag36h11\"\nsize_m = [0.090, 0.040, 0.036]\n", "^family = \"tag36h11\"\n"},
     {"lacks \"size_m\""}},
    {"size_zero", {"0.036]", "^0]"}, {"size_m is 0", "above 0"}},
    {"chamfer_of_half_the_width",
     {"0.036]", "0.036]\nchamfer_m = ^0.02"},
     {"chamfer_m is 0.02", "less than 0.02"}},
    {"no_room_beside_the_chamfer",
     {"0.036]\n[box]\ntag_m = 0.024\ntip_margin_m = 0.005\ntip = 30\ntop = 31\n",
      "0.036]\nchamfer_m = 0.004\n[box]\ntag_m = 0.024\ntip_margin_m = 0.005\ntip = 30\n"
      "upper_left = ^31\n"},
     {"the upper_left face of 0.00565685 x 0.09 m has no room"}},
    {"slanted_face_of_a_plain_box", {"top = 31", "^upper_left = 31"}, {"unknown key"}},
    {"negative_id", {"= 30", "= ^-1"}, {"tip is -1"}},
    {"same_id", {"= 34", "= ^30"}, {"tag 30 is listed twice"}},
    {"not_in_family", {"= 34", "= ^587"}, {"bottom is 587", "0 to 586"}},
    {"unknown_face", {"bottom", "^botom"}, {"unknown key \"botom\"", "\"bottom\""}},
    {"no_face",
     {"[box]\ntag_m = 0.024\ntip_margin_m = 0.005\ntip = 30\ntop = 31\nleft = 32\nright = 33\n"
      "bottom = 34\n",
      "^[box]\ntag_m = 0.024\n"},
     {"[box] has no face"}},
    {"tip_margin_in_millimeters",
     {"0.005\ntip = 30\ntop = 31\nleft = 32\nright = 33\nbottom = 34\n", "5\ntop = ^31\n"},
     {"the top face of 0.04 x 0.09 m has no room", "0.003 m of white"}},
    {"too_large_for_the_tip",
     {"tag_m = 0.024\ntip_margin_m = 0.005\ntip = 30\ntop = 31\nleft = 32\nright = 33\nbottom = 34",
      "tag_m = 0.032\ntip_margin_m = 0.005\ntip = ^30"},
     {"the tip face of 0.04 x 0.036 m has no room", "0.004 m of white"}},
};

const Broken of_effector_tags[] = {
    {"mirrored",
     {"[[0.04, 0.01, 0.02], [0.04, -0.01, 0.02], [0.02, -0.01, 0.02], [0.02, 0.01, 0.02]]",
      "^[[0.04, -0.01, 0.02], [0.04, 0.01, 0.02], [0.02, 0.01, 0.02], [0.02, -0.01, 0.02]]"},
     {"tag 8 faces the effector's center", "clockwise as seen from outside"}},
    {"grid", {"[[tag]]", "[^grid]\n[[tag]]"}, {"unknown key \"grid\""}},
};

class BrokenGrid : public testing::TestWithParam<Broken> {};
TEST_P(BrokenGrid, IsOneMistakeAtItsPlace) {
  expect_broken(board_grid, GetParam(), [](auto& text) { parse_board(text, "x.toml"); });
}
INSTANTIATE_TEST_SUITE_P(BoardFile, BrokenGrid, testing::ValuesIn(of_grid), name_of_broken);

class BrokenTag : public testing::TestWithParam<Broken> {};
TEST_P(BrokenTag, IsOneMistakeAtItsPlace) {
  expect_broken(board_tags, GetParam(), [](auto& text) { parse_board(text, "x.toml"); });
}
INSTANTIATE_TEST_SUITE_P(BoardFile, BrokenTag, testing::ValuesIn(of_tags), name_of_broken);

class BrokenBox : public testing::TestWithParam<Broken> {};
TEST_P(BrokenBox, IsOneMistakeAtItsPlace) {
  expect_broken(effector_box, GetParam(), [](auto& text) { parse_effector(text, "x.toml"); });
}
INSTANTIATE_TEST_SUITE_P(EffectorFile, BrokenBox, testing::ValuesIn(of_box), name_of_broken);

class BrokenEffectorTag : public testing::TestWithParam<Broken> {};
TEST_P(BrokenEffectorTag, IsOneMistakeAtItsPlace) {
  expect_broken(effector_tags, GetParam(), [](auto& text) { parse_effector(text, "x.toml"); });
}
INSTANTIATE_TEST_SUITE_P(EffectorFile, BrokenEffectorTag, testing::ValuesIn(of_effector_tags),
                         name_of_broken);

TEST(BoardFile, ReportsAllMistakesTogether) {
  std::string text = board_tags;
  text.replace(text.find("tag25h9"), 7, "tag25h8");
  text.replace(text.find("id = 34"), 7, "id = -1");
  text += "[[tag]]\n";
  std::string all;
  for (const Mistake& mistake : mistakes_of([&] { parse_board(text, "x.toml"); }))
    all += mistake.message + '\n';
  for (const char* part : {"tag25h8", "id is -1", "lacks \"id\""})
    EXPECT_THAT(all, ::testing::HasSubstr(part));
}

}  // namespace
}  // namespace heft
