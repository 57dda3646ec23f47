#include "view/ArView.h"

#include <array>

#include "base/PlugTable.h"

namespace heft {

namespace {
// Shows nothing: for simulated responders and machines without a display.
class HeadlessView final : public ArView {
 public:
  explicit HeadlessView(const ViewSetup&) {}
  std::optional<double> present(const ViewPicture&, const ScreenState&) override { return {}; }
  std::vector<Touch> wait(double) override { return {}; }
};

template <typename View>
std::unique_ptr<ArView> make(const ViewSetup& setup) {
  return std::make_unique<View>(setup);
}

constexpr std::array table{ViewEntry{"headless", "shows nothing; for simulated responders", false,
                                     false, make<HeadlessView>}};
}  // namespace

std::span<const ViewEntry> views() {
  return table;
}

const ViewEntry& view_named(std::string_view name) {
  return entry_named("view", name, views());
}

}  // namespace heft
