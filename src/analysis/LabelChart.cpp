// Which label which cube of three got, a panel for each condition.
#include <fmt/format.h>

#include <numeric>

#include "analysis/Charts.h"
#include "analysis/Gnuplot.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr int panel_px = 330, left_px = 130, height_px = 430;

// x, y, percentage of the cube's labels, number.
std::string rows_of(const LabelMatrix& matrix) {
  std::string rows;
  for (std::size_t cube = 0; cube < matrix.size(); ++cube) {
    const auto& given = matrix.at(cube);
    const int n = std::accumulate(given.begin(), given.end(), 0);
    for (std::size_t label = 0; label < given.size(); ++label)
      rows += fmt::format("{} {} {:.1f} {}\n", label, cube,
                          n > 0 ? 100.0 * given.at(label) / n : 0.0, given.at(label));
  }
  return rows;
}

std::string panel_script(const std::string& condition, const LabelMatrix& matrix, int index,
                         int width_px) {
  const double left = left_px + index * panel_px;
  return fmt::format(
      "$l{0} << END\n{1}END\nset lmargin at screen {2:.4f}\nset rmargin at screen {3:.4f}\n"
      "set title {4} offset 0,-0.6\n"
      "plot $l{0} using 1:2:3 with image pixels notitle, "
      "$l{0} using 1:2:(sprintf('%d\\n%.0f %%', $4, $3)) with labels notitle\n"
      "unset label\nunset ylabel\nset ytics ('' 0, '' 1, '' 2)\n",
      index, rows_of(matrix), left / width_px, (left + panel_px - 40) / width_px,
      gnuplot_quoted(condition));
}
}  // namespace

Chart label_chart(const Summary& summary) {
  Chart chart{"labels_by_mass", titled("Which label which cube got", summary), ""};
  const auto& labels = summary.points.labels;
  if (labels.empty()) return chart;
  const int width_px = std::max(620, left_px + panel_px * static_cast<int>(labels.size()));
  chart.caption =
      "Sorted trials of three cubes, all participants together, without \"I don't know\": how "
      "often each cube got each label, and in how many percent of its labels. Right ones on the "
      "diagonal.";
  chart.n = summary.n_participants;
  chart.csv = "labels_by_mass.csv";
  chart.script =
      gnuplot_header({chart.name + ".svg", width_px, height_px, chart.title, caption_of(summary)}) +
      "set multiplot\nunset key\nunset colorbox\nset tmargin at screen 1-80*pixel\n"
      "set bmargin at screen caption_top + 66*pixel\nunset grid\nset tics scale 0\n"
      "set palette defined (0 '#ffffff', 100 '#7fb0dd')\nset cbrange [0:100]\n"
      "set xrange [-0.5:2.5]\nset yrange [2.5:-0.5]\n"
      "set xtics ('lightest' 0, 'intermediate' 1, 'heaviest' 2)\n"
      "set ytics ('lightest' 0, 'intermediate' 1, 'heaviest' 2)\n"
      "set xlabel 'label'\nset ylabel 'cube'\n";
  for (int i = 0; const auto& [condition, matrix] : labels)
    chart.script += panel_script(condition, matrix, i++, width_px);
  chart.script += "unset multiplot\n";
  return chart;
}

}  // namespace heft
