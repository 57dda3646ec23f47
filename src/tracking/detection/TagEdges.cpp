#include "tracking/detection/TagEdges.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "tracking/detection/PlanarPose.h"

namespace heft {

namespace {
constexpr double unrefined_sd_px = 0.3;
constexpr double least_edge_quality = 0.6;
constexpr double relative_blur_sd = 0.1;

using Corners = std::array<Eigen::Vector2d, 4>;

Eigen::Vector2d through(const Eigen::Matrix3d& homography, const Eigen::Vector2d& place) {
  return (homography * place.homogeneous()).hnormalized();
}

// Outward bending of a straight edge's middle by the lens.
double sag_px(const Intrinsics& camera, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d middle = (undistort(camera, a) + undistort(camera, b)) / 2;
  const Eigen::Vector2d along = (b - a).normalized();
  return (distort(camera, middle) - (a + b) / 2).dot(Eigen::Vector2d(along.y(), -along.x()));
}

// Width of the cells along an edge's inside, across it.
double cell_px(const Eigen::Matrix3d& pixel_from_square, int n_cells, std::size_t edge) {
  const double d = 1.0 / n_cells;
  const std::array<Eigen::Vector2d, 4> middles{{{.5, 0}, {1, .5}, {.5, 1}, {0, .5}}};
  const std::array<Eigen::Vector2d, 4> inwards{{{0, d}, {-d, 0}, {0, -d}, {d, 0}}};
  const std::array<Eigen::Vector2d, 4> alongs{{{d, 0}, {0, d}, {-d, 0}, {0, -d}}};
  const Eigen::Vector2d middle = through(pixel_from_square, middles[edge]);
  const Eigen::Vector2d in = through(pixel_from_square, middles[edge] + inwards[edge]) - middle;
  const Eigen::Vector2d along =
      (through(pixel_from_square, middles[edge] + alongs[edge]) - middle).normalized();
  return std::abs(in.x() * along.y() - in.y() * along.x());
}

// The intersection of the lines through two edges.
Eigen::Vector2d crossing(const FittedEdge& one, const FittedEdge& other) {
  const Eigen::Vector2d a = one.end_px - one.start_px, b = other.end_px - other.start_px;
  const Eigen::Vector2d between = other.start_px - one.start_px;
  const double t = (between.x() * b.y() - between.y() * b.x()) / (a.x() * b.y() - a.y() * b.x());
  return one.start_px + t * a;
}

bool shows_blur(const FittedEdge& edge) {
  return edge.quality > 0 && !edge.saturated;
}

// Keeps the guess if the fit found no edge.
void take_edge(FittedEdge& edge, const FittedEdge& fitted) {
  edge.quality = 0;
  if (fitted.quality >= least_edge_quality) edge = fitted;
}

// A missing edge gets the brightness and blur of the others; opposite edges have the same blur.
void describe_missing(std::array<FittedEdge, 4>& edges) {
  const auto is_missing = [](const FittedEdge& edge) { return edge.blur_px == 0; };
  const auto n = static_cast<double>(4 - std::ranges::count_if(edges, is_missing));
  if (n == 0 || n == 4) return;
  FittedEdge mean;
  for (const FittedEdge& edge : edges) {
    mean.dark += edge.dark / n;
    mean.bright += edge.bright / n;
    mean.blur_px += edge.blur_px / n;
  }
  const std::array<FittedEdge, 4> found = edges;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!is_missing(found[i])) continue;
    const FittedEdge& opposite = found[(i + 2) % 4];
    edges[i].dark = mean.dark;
    edges[i].bright = mean.bright;
    edges[i].blur_px = is_missing(opposite) ? mean.blur_px : opposite.blur_px;
  }
}

// The guess improved by the first fits: opposite edges have the same blur, also from motion.
EdgeGuess informed(EdgeGuess guess, const std::array<FittedEdge, 4>& edges, std::size_t edge) {
  guess.start_px = edges[edge].start_px;
  guess.end_px = edges[edge].end_px;
  guess.blur_px = (edges[edge].blur_px + edges[(edge + 2) % 4].blur_px) / 2;
  guess.blur_sd_px = relative_blur_sd * guess.blur_px;
  return guess;
}

double value_at(const Image& gray, const Eigen::Vector2d& pixel) {
  const double x = std::clamp(pixel.x(), 0.0, gray.width - 1.001);
  const double y = std::clamp(pixel.y(), 0.0, gray.height - 1.001);
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const double right = x - static_cast<double>(column), down = y - static_cast<double>(row);
  const std::uint8_t* p = &gray.pixels[row * gray.row_bytes() + column];
  const std::uint8_t* below = p + gray.row_bytes();
  return (1 - down) * ((1 - right) * p[0] + right * p[1]) +
         down * ((1 - right) * below[0] + right * below[1]);
}

double agreement(const Image& gray, const TagPattern& pattern, const MeasuredTag& tag) {
  double middle = 0;
  for (const FittedEdge& edge : tag.edges) middle += (edge.dark + edge.bright) / 8;
  const Eigen::Matrix3d pixel_from_square = square_to(tag.corners_px);
  const int margin = pattern.margin_cells();
  const auto agrees = [&](const TagPattern::Cell& cell) {
    const Eigen::Vector2d from_border(cell.column - margin, cell.row - margin);
    const Eigen::Vector2d place = (from_border + Eigen::Vector2d(0.5, 0.5)) / pattern.border_cells;
    return (value_at(gray, through(pixel_from_square, place)) > middle) ==
           pattern.is_white(cell.column, cell.row);
  };
  return static_cast<double>(std::ranges::count_if(pattern.data, agrees)) /
         static_cast<double>(pattern.data.size());
}
}  // namespace

std::vector<TagPattern> patterns_of(const MarkerBody& body) {
  std::vector<TagPattern> patterns;
  for (const Tag& tag : body.tags) patterns.push_back(tag_pattern(body.family, tag.id));
  return patterns;
}

namespace {
std::array<EdgeGuess, 4> guesses_of(const Intrinsics& camera, const TagPattern& pattern,
                                    const Corners& corners_px, const EdgeMeasuring& how) {
  const Eigen::Matrix3d pixel_from_square = square_to(corners_px);
  std::array<EdgeGuess, 4> guesses;
  for (std::size_t i = 0; i < 4; ++i) {
    EdgeGuess& guess = guesses[i];
    guess.start_px = corners_px[i];
    guess.end_px = corners_px[(i + 1) % 4];
    guess.sag_px = sag_px(camera, guess.start_px, guess.end_px);
    guess.cell_px = cell_px(pixel_from_square, pattern.border_cells, i);
    guess.blur_px = how.blur_px;
    guess.bright_outside = pattern.bright_outside;
    guess.noise = how.noise;
    guess.curve = how.curve;
  }
  return guesses;
}

MeasuredTag with_edges(MeasuredTag tag, const Image& gray, const TagPattern& pattern) {
  describe_missing(tag.edges);
  tag.quality = 0;
  for (const FittedEdge& edge : tag.edges) {
    tag.quality += edge.quality / 4;
    tag.saturated += edge.saturated ? 0.25 : 0;
  }
  for (std::size_t i = 0; i < 4; ++i)
    tag.corners_px[i] = crossing(tag.edges[(i + 3) % 4], tag.edges[i]);
  tag.agreement = agreement(gray, pattern, tag);
  return tag;
}
}  // namespace

MeasuredTag measure_tag(const Image& gray, const Intrinsics& camera, const TagPattern& pattern,
                        const Corners& corners_px, const EdgeMeasuring& how) {
  std::array<EdgeGuess, 4> guesses = guesses_of(camera, pattern, corners_px, how);
  MeasuredTag tag = unrefined_tag(corners_px);
  for (std::size_t i = 0; i < 4; ++i) {
    take_edge(tag.edges[i], fit_edge(gray, guesses[i], how.most_pixels));
    if (how.whole && tag.edges[i].quality == 0) {
      tag.quality = tag.agreement = 0;
      return tag;
    }
  }
  if (std::ranges::all_of(tag.edges, shows_blur))
    for (std::size_t i = 0; i < 4; ++i) {
      guesses[i].needs_curve_evidence = how.needs_curve_evidence;
      take_edge(tag.edges[i], fit_edge(gray, informed(guesses[i], tag.edges, i), how.most_pixels));
    }
  return with_edges(std::move(tag), gray, pattern);
}

MeasuredTag measure_tag_again(const Image& gray, const Intrinsics& camera,
                              const TagPattern& pattern, const Corners& corners_px,
                              const std::array<double, 2>& blur_px, const EdgeMeasuring& how) {
  std::array<EdgeGuess, 4> guesses = guesses_of(camera, pattern, corners_px, how);
  MeasuredTag tag = unrefined_tag(corners_px);
  for (std::size_t i = 0; i < 4; ++i) {
    guesses[i].blur_px = blur_px[1 - i % 2];
    guesses[i].blur_sd_px = relative_blur_sd * guesses[i].blur_px;
    guesses[i].needs_curve_evidence = how.needs_curve_evidence;
    const FittedEdge fitted = fit_edge(gray, guesses[i], how.most_pixels);
    if (fitted.quality < least_edge_quality || !shows_blur(fitted))
      return measure_tag(gray, camera, pattern, corners_px, how);
    tag.edges[i] = fitted;
  }
  return with_edges(std::move(tag), gray, pattern);
}

std::optional<MeasuredTag> without_covered_edges(MeasuredTag tag, double least_quality) {
  constexpr int least_edges = 2;
  int n_clear = 0;
  for (FittedEdge& edge : tag.edges) {
    if (edge.quality >= least_quality) {
      ++n_clear;
    } else {
      edge.dark = edge.bright = edge.blur_px = 0;  // will get the values of the clear ones
      edge.sd_px = std::numeric_limits<double>::infinity();
    }
  }
  if (n_clear < least_edges) return std::nullopt;
  describe_missing(tag.edges);
  return tag;
}

MeasuredTag unrefined_tag(const Corners& corners_px) {
  MeasuredTag tag;
  tag.corners_px = corners_px;
  for (std::size_t i = 0; i < 4; ++i) {
    FittedEdge& edge = tag.edges[i];
    edge.start_px = edge.points_px[0] = corners_px[i];
    edge.end_px = edge.points_px[1] = corners_px[(i + 1) % 4];
    edge.sd_px = unrefined_sd_px;
    edge.quality = 1;
  }
  tag.quality = tag.agreement = 1;
  return tag;
}

}  // namespace heft
