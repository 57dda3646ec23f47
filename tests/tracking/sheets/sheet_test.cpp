// Rendered sheets: positions are those of the files, in true millimeters, and the net folds into
// the box.
#include "tracking/sheets/Sheet.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/Error.h"
#include "tracking/Scenes.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/detection/TagDetector.h"

namespace heft {
namespace {

constexpr double px_per_mm = 300 / 25.4;

// A folder that is removed after the test.
class Sheets : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("heft_sheet_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // The first page as poppler draws it, 300 dots an inch, gray.
  Image first_page(const std::string& pdf) const {
    const std::string page = path("page");
    const std::string command =
        "pdftoppm -r 300 -f 1 -singlefile -gray '" + pdf + "' '" + page + "'";
    if (std::system(command.c_str()) != 0) throw Error("pdftoppm (poppler-utils) is needed");
    return read_image(page + ".pgm");
  }

  std::filesystem::path folder_;
};

constexpr double chamfer_m = 0.025;
const Eigen::Vector3d chamfered_size_m(0.090, 0.085, 0.040);

// The shipped effector that shows two faces.
MarkerBody chamfered_effector() {
  MarkerBody effector;
  effector.size_m = chamfered_size_m;
  effector.chamfer_m = chamfer_m;
  int id = 40;
  for (const BoxFace face : faces_of(effector.box())) {
    if (face == BoxFace::left || face == BoxFace::right || face == BoxFace::back) continue;
    const Eigen::Vector2d center_m(0, face == BoxFace::tip ? 0 : 0.027);
    effector.tags.push_back(tag_on(face_frame(effector.box(), face), id++, center_m, 0.028));
  }
  return effector;
}

using TagCorners = std::map<int, std::array<Eigen::Vector2d, 4>>;

// Millimeters from the page's upper left corner.
TagCorners tags_on(const Image& page, const std::string& family) {
  TagDetector detector(family, 2);
  TagCorners corners_mm;
  for (const DetectedTag& tag : detector.detect(page, whole(page)))
    for (std::size_t c = 0; c < 4; ++c)
      corners_mm[tag.id][c] = (tag.corners_px[c] + Eigen::Vector2d(0.5, 0.5)) / px_per_mm;
  return corners_mm;
}

// Compares printed corners, in mm from the mean of all, with the board's.
void expect_as_designed(const TagCorners& found_mm, const MarkerBody& board) {
  ASSERT_EQ(found_mm.size(), board.tags.size());
  Eigen::Vector2d middle(0, 0);
  for (const auto& [id, corners] : found_mm)
    for (const auto& corner : corners) middle += corner / (4.0 * double(found_mm.size()));
  for (const Tag& tag : board.tags)
    for (std::size_t c = 0; c < 4; ++c) {
      const Eigen::Vector2d from_middle = found_mm.at(tag.id)[c] - middle;
      const Eigen::Vector2d wanted = tag.corners_m[c].head<2>() * 1000;
      EXPECT_LT((Eigen::Vector2d(from_middle.x(), -from_middle.y()) - wanted).norm(), 0.05)
          << "tag " << tag.id << " corner " << c;
    }
}

TEST_F(Sheets, BoardIsTrueToSize) {
  const MarkerBody board = grid_board(6, 4, 0.040, 0.048);
  write_board_sheet(board, Paper::a4, path("board.pdf"));
  const Image page = first_page(path("board.pdf"));
  EXPECT_EQ(page.width, 3508);  // A4 across
  EXPECT_NEAR(page.height, 2480, 1);
  expect_as_designed(tags_on(page, "tag36h11"), board);
}

TEST_F(Sheets, BoardOfAFamilyWithDataAroundIsTrueToSize) {
  MarkerBody board = grid_board(2, 3, 0.030, 0.056);
  board.family = "tagStandard41h12";
  write_board_sheet(board, Paper::letter, path("board.pdf"));
  expect_as_designed(tags_on(first_page(path("board.pdf")), "tagStandard41h12"), board);
}

// Printing again after measuring the ruler gives the same sheet.
TEST_F(Sheets, AreDrawnAsDesignedAfterMeasuring) {
  const MarkerBody board = grid_board(3, 3, 0.040, 0.048);
  MarkerBody measured = grid_board(3, 3, 0.0392, 0.04704);
  measured.measured_ruler_m = 0.147;
  write_board_sheet(measured, Paper::a4, path("board.pdf"));
  expect_as_designed(tags_on(first_page(path("board.pdf")), "tag36h11"), board);
}

TEST_F(Sheets, AreDrawnAsDesignedAfterMeasuringBothDirections) {
  const MarkerBody board = grid_board(3, 3, 0.040, 0.048);
  MarkerBody measured = board;
  for (Tag& tag : measured.tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m)
      corner_m = corner_m.cwiseProduct(Eigen::Vector3d(0.98, 1.02, 1));
  measured.measured_ruler_m = 0.147;
  measured.measured_across_m = 0.153;
  write_board_sheet(measured, Paper::a4, path("board.pdf"));
  expect_as_designed(tags_on(first_page(path("board.pdf")), "tag36h11"), board);
}

// Centers of the dark marks in a row, mm.
std::vector<double> marks_mm(const Image& page, int row) {
  std::vector<double> marks;
  double sum = 0, moment = 0;
  for (int x = 0; x < page.width; ++x) {
    const double ink =
        255.0 -
        page.pixels[static_cast<std::size_t>(row) * page.row_bytes() + static_cast<std::size_t>(x)];
    sum += ink;
    moment += ink * (x + 0.5);
    if (ink > 0 || sum == 0) continue;
    marks.push_back(moment / sum / px_per_mm);
    sum = moment = 0;
  }
  return marks;
}

Image transposed(const Image& page) {
  Image turned(page.height, page.width, 1);
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x)
      turned
          .pixels[static_cast<std::size_t>(x) * turned.row_bytes() + static_cast<std::size_t>(y)] =
          page.pixels[static_cast<std::size_t>(y) * page.row_bytes() + static_cast<std::size_t>(x)];
  return turned;
}

// Only the outermost ticks of the ruler down the sheet reach so far from its left edge.
void expect_ruler_down(const Image& page, double from_left_mm) {
  const std::vector<double> marks =
      marks_mm(transposed(page), static_cast<int>(from_left_mm * px_per_mm));
  ASSERT_GE(marks.size(), 2u);
  EXPECT_NEAR(marks[1] - marks[0], 150.0, 0.03);
}

// Only the outermost ticks of the ruler reach this high.
void expect_ruler(const Image& page) {
  const int row = page.height - static_cast<int>((5 + 4 + 3.5) * px_per_mm);
  const std::vector<double> marks = marks_mm(page, row);
  ASSERT_GE(marks.size(), 2u);
  EXPECT_NEAR(marks[1] - marks[0], 150.0, 0.03);
}

TEST_F(Sheets, RulersAre150MillimetersLong) {
  write_board_sheet(grid_board(2, 2, 0.040, 0.048), Paper::letter, path("b.pdf"));
  expect_ruler(first_page(path("b.pdf")));
  write_effector_sheet(box_effector(0.032), Paper::a4, path("e.pdf"));
  expect_ruler(first_page(path("e.pdf")));
}

constexpr double board_ruler_mm = 5 + 0.4 + 1.2, effector_ruler_mm = 5 + 5.5 + 3.5;

TEST_F(Sheets, HaveARulerEachWay) {
  write_board_sheet(grid_board(6, 4, 0.040, 0.048), Paper::a4, path("b.pdf"));
  expect_ruler_down(first_page(path("b.pdf")), board_ruler_mm);
  for (const Paper paper : {Paper::a4, Paper::letter}) {
    const std::string box = path(std::string(name_of(paper)) + "box.pdf");
    write_effector_sheet(box_effector(0.032), paper, box);
    expect_ruler_down(first_page(box), effector_ruler_mm);
    const std::string chamfered = path(std::string(name_of(paper)) + "chamfered.pdf");
    write_effector_sheet(chamfered_effector(), paper, chamfered);
    expect_ruler_down(first_page(chamfered), effector_ruler_mm);
  }
}

// The ruler must not be in the white margin of tags.
TEST_F(Sheets, RulerLeavesTheTagsTheirWhite) {
  write_board_sheet(grid_board(6, 4, 0.040, 0.048), Paper::a4, path("b.pdf"));
  const TagCorners found_mm = tags_on(first_page(path("b.pdf")), "tag36h11");
  for (const auto& [id, corners] : found_mm) {
    EXPECT_GE(corners[0].x(), 6.8 + 5 - 0.02) << id;
    EXPECT_LE(corners[1].x(), 297 - 5 + 0.02) << id;
  }
}

bool is_on(const NetFace& face, const NetPoint& p) {
  return face.frame.inside_m(face.frame.flat(face.on_box(p))) > -1e-9;
}

// Faces that meet on the net meet on the box, and the printed side of the paper is outside.
void expect_folds(const BoxShape& box) {
  const EffectorNet net = effector_net(box);
  ASSERT_EQ(net.faces.size(), faces_of(box).size());
  std::size_t n_hinges = 0;
  for (const auto& fold : net.folds_m) {
    std::vector<const NetFace*> meeting;
    for (const NetFace& face : net.faces)
      if (is_on(face, fold[0]) && is_on(face, fold[1])) meeting.push_back(&face);
    if (meeting.size() < 2) continue;  // a flap
    ++n_hinges;
    for (const NetPoint& p : fold)
      EXPECT_LT((meeting[0]->on_box(p) - meeting[1]->on_box(p)).norm(), 1e-12);
  }
  EXPECT_EQ(n_hinges, net.faces.size() - 1);  // all in one piece
  for (const NetFace& face : net.faces) {
    EXPECT_GT(face.frame.normal().dot(face.frame.center_m), 0);
    EXPECT_NEAR(face.frame.normal().norm(), 1, 1e-12);
  }
}

// Edges that are not folded between two faces are glued: each has one flap for two edges that meet.
void expect_closes(const BoxShape& box) {
  const EffectorNet net = effector_net(box);
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
  for (const NetFace& face : net.faces) {
    const auto corners = face.corners_m();
    for (std::size_t i = 0; i < corners.size(); ++i)
      edges.push_back({face.on_box(corners[i]), face.on_box(corners[(i + 1) % corners.size()])});
  }
  for (const auto& [from, to] : edges) {  // clockwise on one face, the other way on its neighbor
    const auto is_its_neighbor = [&, a = from, b = to](const auto& other) {
      return (other[0] - b).norm() < 1e-9 && (other[1] - a).norm() < 1e-9;
    };
    EXPECT_EQ(std::ranges::count_if(edges, is_its_neighbor), 1) << from.transpose();
  }
}

TEST_F(Sheets, NetFoldsIntoTheBox) {
  expect_folds(Eigen::Vector3d(0.090, 0.040, 0.036));
  expect_closes(Eigen::Vector3d(0.090, 0.040, 0.036));
}

TEST_F(Sheets, NetFoldsIntoTheChamferedBox) {
  expect_folds({chamfered_size_m, chamfer_m});
  expect_closes({chamfered_size_m, chamfer_m});
}

// Two pieces of paper overlap if a point well inside one is inside the other.
TEST_F(Sheets, FacesLieBesideEachOther) {
  for (const BoxShape& box :
       {BoxShape(Eigen::Vector3d(0.090, 0.040, 0.036)), BoxShape(chamfered_size_m, chamfer_m)}) {
    const EffectorNet net = effector_net(box);
    for (double x = 0.0005; x < net.size_m.x(); x += 0.003)
      for (double y = 0.0005; y < net.size_m.y(); y += 0.003) {
        const auto holds = [&](const NetFace& face) {
          return face.frame.inside_m(face.frame.flat(face.on_box({x, y}))) > 1e-9;
        };
        EXPECT_LE(std::ranges::count_if(net.faces, holds), 1) << x << " " << y;
      }
  }
}

void expect_folded_tags(const MarkerBody& effector, const TagCorners& found_mm) {
  ASSERT_EQ(found_mm.size(), effector.tags.size());
  const EffectorNet net = effector_net(effector.box());
  const auto face_with = [&](const Tag& tag) { return net.at(face_of(effector.box(), tag)); };
  // Where the net's origin is on the page: from one corner of one tag.
  const Tag& first = effector.tags.front();
  const NetPoint start = face_with(first).on_net(first.corners_m[0]) * 1000;
  const Eigen::Vector2d origin_mm =
      found_mm.at(first.id)[0] - Eigen::Vector2d(start.x(), -start.y());
  for (const Tag& tag : effector.tags)
    for (std::size_t c = 0; c < 4; ++c) {
      const Eigen::Vector2d on_page = found_mm.at(tag.id)[c] - origin_mm;
      const NetPoint on_net = Eigen::Vector2d(on_page.x(), -on_page.y()) / 1000;
      EXPECT_LT((face_with(tag).on_box(on_net) - tag.corners_m[c]).norm(), 0.00008)
          << "tag " << tag.id << " corner " << c;
    }
}

TEST_F(Sheets, FoldedTagsAreWhereTheFileSays) {
  for (const MarkerBody& effector : {box_effector(0.032), chamfered_effector()}) {
    const std::string pdf = path(std::to_string(effector.tags.front().id) + ".pdf");
    write_effector_sheet(effector, Paper::a4, pdf);
    expect_folded_tags(effector, tags_on(first_page(pdf), effector.family));
  }
}

std::string refusal(const std::function<void()>& draw) {
  try {
    draw();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Sheets, RefuseWhatDoesNotFit) {
  const MarkerBody board = grid_board(6, 4, 0.040, 0.048);
  const std::string why = refusal([&] { write_board_sheet(board, Paper::letter, path("x.pdf")); });
  EXPECT_NE(why.find("280 x 184 mm"), std::string::npos) << why;
  EXPECT_NE(why.find("letter"), std::string::npos) << why;
  MarkerBody effector = box_effector(0.032);
  effector.size_m.x() = 0.300;
  effector.tags.clear();
  EXPECT_NE(refusal([&] { write_effector_sheet(effector, Paper::a4, path("x.pdf")); }), "");
  EXPECT_FALSE(std::filesystem::exists(path("x.pdf")));
}

TEST_F(Sheets, RefuseTagsThatAreNotOnTheSheet) {
  MarkerBody board = grid_board(2, 2, 0.040, 0.048);
  for (Eigen::Vector3d& corner : board.tags[2].corners_m) corner.z() = 0.01;
  EXPECT_NE(refusal([&] { write_board_sheet(board, Paper::a4, path("x.pdf")); }).find("tag 2 "),
            std::string::npos);
  MarkerBody effector = box_effector(0.032);
  for (Eigen::Vector3d& corner : effector.tags[1].corners_m) corner.z() += 0.01;
  EXPECT_NE(
      refusal([&] { write_effector_sheet(effector, Paper::a4, path("x.pdf")); }).find("tag 31 "),
      std::string::npos);
}

TEST_F(Sheets, SayWhereTheyCannotBeWritten) {
  const MarkerBody board = grid_board(2, 2, 0.040, 0.048);
  const std::string file = path("no_such_folder/x.pdf");
  EXPECT_NE(refusal([&] { write_board_sheet(board, Paper::a4, file); }).find(file),
            std::string::npos);
}

}  // namespace
}  // namespace heft
