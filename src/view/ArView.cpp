#include "view/ArView.h"

#include <fmt/format.h>

#include <array>

#include "base/Error.h"
#include "base/Names.h"

namespace heft {

namespace {
// Shows nothing: for simulated responders and machines without a display.
class HeadlessView final : public ArView {
 public:
  double present(const DisplayedFrame&, const ScreenState&, double now_s) override { return now_s; }
};

template <typename View>
std::unique_ptr<ArView> make() {
  return std::make_unique<View>();
}

constexpr std::array table{
    ViewEntry{"headless", "shows nothing; for simulated responders", make<HeadlessView>}};
}  // namespace

std::span<const ViewEntry> views() {
  return table;
}

std::unique_ptr<ArView> make_view(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ViewEntry& entry : table) {
    if (entry.name == name) return entry.make();
    names.push_back(entry.name);
  }
  throw Error(
      fmt::format("there is no view \"{}\" in this version; expected {}", name, quoted_list(names)),
      ExitCode::usage);
}

}  // namespace heft
