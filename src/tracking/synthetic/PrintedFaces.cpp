#include "tracking/synthetic/PrintedFaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagFamily.h"

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double sheet_margin_m = 0.006;
constexpr double off_face_m = 0.003;    // tolerance of a badly glued label
constexpr double upright_cosine = 0.9;  // and of its direction

// A tag's cells as a grid over its four corners: bilinear, which is exact for parallelograms. Cells
// are counted from the detected border's top left.
class CellGrid {
 public:
  CellGrid(const Tag& tag, const TagPattern& pattern)
      : corners_m_(tag.corners_m), cells_(pattern.border_cells), margin_(pattern.margin_cells()) {}

  Vector3d at(double column, double row) const {
    const double u = (column - margin_) / cells_;
    const double v = (row - margin_) / cells_;
    return (1 - v) * ((1 - u) * corners_m_[0] + u * corners_m_[1]) +
           v * ((1 - u) * corners_m_[3] + u * corners_m_[2]);
  }
  std::array<Vector3d, 4> rectangle(double column0, double row0, double column1,
                                    double row1) const {
    return {at(column0, row0), at(column1, row0), at(column1, row1), at(column0, row1)};
  }

  double cell_m() const { return (corners_m_[1] - corners_m_[0]).norm() / cells_; }

 private:
  std::array<Vector3d, 4> corners_m_;
  int cells_, margin_;
};

// Bands of columns or rows: even ones are covered by the ink of the cells on both sides of a line,
// odd ones are the rest of a cell.
struct InkBands {
  const TagPattern& pattern;
  double ink_cells;

  int n() const { return 2 * pattern.n_cells + 1; }
  double begin(int band) const { return band / 2 + (band % 2 == 0 ? -ink_cells : ink_cells); }
  bool is_black(int column, int row) const {
    for (int y = (row - 1) / 2; y <= row / 2; ++y)
      for (int x = (column - 1) / 2; x <= column / 2; ++x)
        if (x < pattern.n_cells && y < pattern.n_cells && !pattern.is_white(x, y)) return true;
    return false;
  }
};

// Ink spreads by ink_m beyond the black cells' edges.
void add_spread_cells(PrintedFace& face, const CellGrid& grid, const TagPattern& pattern,
                      double ink_m) {
  const InkBands bands{pattern, ink_m / grid.cell_m()};
  for (int row = 0; row < bands.n(); ++row)
    for (int begin = 0, end = 0; begin < bands.n(); begin = end + 1) {
      for (end = begin; end < bands.n() && bands.is_black(end, row);) ++end;
      if (end > begin)
        face.quads.push_back({grid.rectangle(bands.begin(begin), bands.begin(row), bands.begin(end),
                                             bands.begin(row + 1)),
                              change(material::paper, material::ink)});
    }
}

void add_black_cells(PrintedFace& face, const CellGrid& grid, const TagPattern& pattern,
                     double ink_m) {
  if (ink_m > 0) return add_spread_cells(face, grid, pattern, ink_m);
  for (int row = 0; row < pattern.n_cells; ++row)
    for (int column = 0; column < pattern.n_cells; ++column)
      if (!pattern.is_white(column, row))
        face.quads.push_back({grid.rectangle(column, row, column + 1, row + 1),
                              change(material::paper, material::ink)});
}

// Quadrilaterals side by side; for a remaining triangle the last corner is repeated.
std::vector<std::array<Vector3d, 4>> in_quads(const std::vector<Vector3d>& corners_m) {
  std::vector<std::array<Vector3d, 4>> quads;
  for (std::size_t i = 1; i + 1 < corners_m.size(); i += 2)
    quads.push_back({corners_m[0], corners_m[i], corners_m[i + 1],
                     corners_m[std::min(i + 2, corners_m.size() - 1)]});
  return quads;
}

PrintedFace bare_face(const FaceFrame& frame, const Eigen::Array3f& color) {
  std::vector<Vector3d> corners_m;
  for (const Vector2d& corner_m : frame.outline_m()) corners_m.push_back(frame.at(corner_m));
  PrintedFace face{frame.center_m, frame.normal(), {}};
  for (const auto& quad_m : in_quads(corners_m)) face.quads.push_back({quad_m, solid(color)});
  return face;
}

bool is_on(const FaceFrame& frame, const Tag& tag) {
  const Vector3d from_face_m = tag_center_m(tag) - frame.center_m;
  return tag_normal(tag).dot(frame.normal()) > upright_cosine &&
         std::abs(from_face_m.dot(frame.normal())) < off_face_m &&
         (frame.flat(tag_center_m(tag)).cwiseAbs().array() < frame.size_m.array() / 2).all();
}

// The smallest upright rectangle on a face around its tags' prints, including quiet zones, and a
// margin; clipped to the face.
class Paper {
 public:
  void add(const FaceFrame& frame, const CellGrid& grid, int n_cells) {
    for (const Vector3d& corner : grid.rectangle(0, 0, n_cells, n_cells)) {
      low_ = low_.cwiseMin(frame.flat(corner));
      high_ = high_.cwiseMax(frame.flat(corner));
    }
  }
  bool empty() const { return (high_.array() < low_.array()).any(); }
  std::array<Vector3d, 4> rectangle(const FaceFrame& frame, double margin_m) const {
    const Vector2d half_m = frame.size_m / 2;
    const Vector2d low = (low_.array() - margin_m).matrix().cwiseMax(-half_m);
    const Vector2d high = (high_.array() + margin_m).matrix().cwiseMin(half_m);
    return {frame.at({low.x(), high.y()}), frame.at(high), frame.at({high.x(), low.y()}),
            frame.at(low)};
  }

 private:
  Vector2d low_ = Vector2d::Constant(1e9), high_ = Vector2d::Constant(-1e9);
};

PrintedFace effector_face(const FaceFrame& frame, const MarkerBody& effector, double ink_m) {
  PrintedFace face = bare_face(frame, material::box);
  PrintedFace cells;
  Paper label;
  for (const Tag& tag : effector.tags) {
    if (!is_on(frame, tag)) continue;
    const TagPattern pattern = tag_pattern(effector.family, tag.id);
    const CellGrid grid(tag, pattern);
    label.add(frame, grid, pattern.n_cells);
    add_black_cells(cells, grid, pattern, ink_m);
  }
  if (label.empty()) return face;
  face.quads.push_back({label.rectangle(frame, 0), change(material::box, material::paper)});
  face.quads.insert(face.quads.end(), cells.quads.begin(), cells.quads.end());
  return face;
}

void check_on_box(const std::vector<FaceFrame>& frames, const Tag& tag) {
  if (std::ranges::none_of(frames, [&](const FaceFrame& frame) { return is_on(frame, tag); }))
    throw Error(
        fmt::format("the synthetic camera shows tags on the effector's faces, but tag {} "
                    "is on none of them; check size_m and the tag's corners",
                    tag.id));
}

void check_on_table(const Tag& tag) {
  for (const Vector3d& corner : tag.corners_m)
    if (std::abs(corner.z()) > 1e-5)
      throw Error(
          fmt::format("the synthetic camera only shows boards that lie on the table, but "
                      "tag {} is {:.2f} mm off it",
                      tag.id, 1e3 * corner.z()));
}
}  // namespace

PrintedFace printed_board(const MarkerBody& board, double ink_m) {
  const FaceFrame table{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), {10, 10}};
  PrintedFace face{Vector3d::Zero(), Vector3d::UnitZ(), {}};
  Paper sheet;
  for (const Tag& tag : board.tags) {
    check_on_table(tag);
    const TagPattern pattern = tag_pattern(board.family, tag.id);
    const CellGrid grid(tag, pattern);
    sheet.add(table, grid, pattern.n_cells);
    add_black_cells(face, grid, pattern, ink_m);
  }
  if (!sheet.empty())
    face.quads.insert(face.quads.begin(),
                      {sheet.rectangle(table, sheet_margin_m), solid(material::paper)});
  return face;
}

std::vector<PrintedFace> printed_effector(const MarkerBody& effector, double ink_m) {
  if (effector.tags.empty() && effector.size_m.isZero()) return {};
  std::vector<FaceFrame> frames;
  for (const BoxFace face : faces_of(effector.box()))
    frames.push_back(face_frame(effector.box(), face));
  for (const Tag& tag : effector.tags) check_on_box(frames, tag);
  std::vector<PrintedFace> faces;
  for (const FaceFrame& frame : frames) faces.push_back(effector_face(frame, effector, ink_m));
  return faces;
}

}  // namespace heft
