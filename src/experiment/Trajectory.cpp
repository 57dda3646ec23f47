#include "experiment/Trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/Error.h"
#include "base/Names.h"
#include "base/Pose.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 8> columns{"t_s", "x_m", "y_m", "z_m",
                                                  "qw",  "qx",  "qy",  "qz"};

// Limits that exceed any experiment and that the physics can still compute with.
constexpr double furthest_m = 1e6, latest_s = 1e12;

bool is_within(std::size_t column, double value) {
  return std::abs(value) <= (column == 0 ? latest_s : furthest_m);
}

// Reads a file row by row and collects all mistakes.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  void header(std::string_view line) {
    const auto cells = cells_of(line);
    if (!std::ranges::equal(cells, columns))
      mistake(1, 1, fmt::format("expected the header {}", fmt::join(columns, ",")));
  }

  void row(int number, std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != columns.size()) {
      return mistake(number, 1,
                     fmt::format("{}, expected {} ({})", counted(std::ssize(cells), "cell"),
                                 columns.size(), fmt::join(columns, ",")));
    }
    const auto place = [&](std::size_t i) {
      return static_cast<int>(cells[i].data() - line.data()) + 1;
    };
    const bool out_of_view =
        std::all_of(cells.begin() + 1, cells.end(), [](auto cell) { return cell.empty(); });
    std::array<double, columns.size()> values{};
    const std::size_t filled = out_of_view ? 1 : columns.size();
    bool usable = true;
    for (std::size_t i = 0; i < filled; ++i) {
      const auto value = number_in(cells[i]);
      if (!value) {
        mistake(number, place(i),
                fmt::format("{} is \"{}\", expected a finite number", columns[i],
                            printable(std::string(cells[i]))));
        usable = false;
      } else if (!is_within(i, *value)) {
        mistake(number, place(i),
                fmt::format("{} is {}, expected an absolute value of at most {:g}", columns[i],
                            *value, i == 0 ? latest_s : furthest_m));
        usable = false;
      } else {
        values[i] = *value;
      }
    }
    if (!usable) return;
    if (last_s_ && values[0] <= *last_s_)
      return mistake(number, 1, fmt::format("t_s {} does not come after {}", values[0], *last_s_));
    last_s_ = values[0];
    rows.push_back({values[0], out_of_view ? std::nullopt : pose(values, number, place(4))});
  }

  void mistake(int line, int column, std::string message) {
    mistakes.push_back({{file_, line, column}, std::move(message)});
  }

  std::vector<TrajectoryRow> rows;
  std::vector<Mistake> mistakes;

 private:
  std::optional<Pose> pose(std::span<const double> v, int line, int column) {
    const Eigen::Quaterniond q(v[4], v[5], v[6], v[7]);
    if (std::abs(q.norm() - 1) > 1e-3)
      mistake(line, column,
              fmt::format("qw,qx,qy,qz has length {:.6g}, expected a unit quaternion", q.norm()));
    return Pose{{v[1], v[2], v[3]}, q.normalized()};
  }

  std::string file_;
  std::optional<double> last_s_;
};
}  // namespace

std::optional<Pose> Trajectory::at(double t_s) const {
  const auto after = std::ranges::upper_bound(rows_, t_s, {}, &TrajectoryRow::t_s);
  if (after == rows_.begin()) return rows_.front().pose;
  const auto before = after - 1;
  if (after == rows_.end() || before->t_s == t_s) return before->pose;
  if (!before->pose || !after->pose) return std::nullopt;
  return interpolate(*before->pose, *after->pose, (t_s - before->t_s) / (after->t_s - before->t_s));
}

Trajectory parse_trajectory(const std::string& text, const std::string& file) {
  Reader reader(file);
  const auto lines = lines_of(text);
  reader.header(lines.empty() ? "" : lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (!lines[i].empty()) reader.row(static_cast<int>(i) + 1, lines[i]);
  if (reader.rows.empty() && reader.mistakes.empty())
    reader.mistake(1, 1, "the file has no rows, expected at least one pose");
  if (!reader.mistakes.empty()) throw InvalidFile(std::move(reader.mistakes));
  return Trajectory(std::move(reader.rows));
}

Trajectory load_trajectory(const std::string& path) {
  return parse_trajectory(read_text_file(path), path);
}

}  // namespace heft
