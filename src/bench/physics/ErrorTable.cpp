#include "bench/physics/ErrorTable.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "base/TextFile.h"
#include "physics/auto/ErrorTable.h"

namespace heft {

std::string error_table_text(std::string_view errors_csv) {
  const auto lines = lines_of(errors_csv);
  if (lines.empty()) throw Error("errors.csv is empty");
  const auto names = cells_of(lines.front());
  const auto column = [&](std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw Error(fmt::format("errors.csv has no column {}", name));
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t simulator = column("simulator"), rate = column("rate_hz"),
                    kind = column("scene_class"), blew_up = column("n_blew_up"),
                    clone = column("worst_clone_rms_mm"), lag = column("worst_lag_error_g");
  std::string text =
      "// Written from results/physics/errors.csv; see src/bench/physics/ErrorTable.h.\n";
  for (std::string_view wanted : ladder_of_simulators) {
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const auto cells = cells_of(lines[i]);
      if (cells.size() != names.size() || cells[simulator] != wanted) continue;
      const auto clone_mm = number_in(cells[clone]), lag_g = number_in(cells[lag]);
      if (cells[blew_up] != "0" || !clone_mm || !lag_g) continue;
      text += fmt::format("{{\"{}\", {}, SceneClass::{}, {:.3g}, {:.3g}}},\n", wanted, cells[rate],
                          cells[kind], *clone_mm, *lag_g);
    }
  }
  return text;
}

}  // namespace heft
