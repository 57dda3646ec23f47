#include "view/ArView.h"

#include <array>

#include "base/PlugTable.h"
#include "view/VideoView.h"
#include "view/window/WindowView.h"

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

constexpr std::array table{
    ViewEntry{"headless", "shows nothing; for simulated responders", false, false,
              make<HeadlessView>},
    ViewEntry{"window", "the participant's screen, for touch, mouse and keys", true, false,
              make<WindowView>},
    ViewEntry{"video", "writes what would be seen into a video file: video:session.mp4", false,
              true, make_video_view}};
}  // namespace

std::span<const ViewEntry> views() {
  return table;
}

const ViewEntry& view_named(std::string_view name) {
  return entry_named("view", name, views());
}

}  // namespace heft
