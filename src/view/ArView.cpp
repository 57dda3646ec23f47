#include "view/ArView.h"

#include <array>

#include "base/PlugTable.h"

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
  return entry_named("view", name, views()).make();
}

}  // namespace heft
