#include <array>

#include "base/Names.h"
#include "results/tracking/Filming.h"
#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {

namespace {
constexpr std::string_view ours = "heft", plain = "apriltag + solvePnP";
constexpr std::array decimations{1.0, 1.5, 2.0, 3.0};

struct Refinement {
  std::string_view name;
  bool cells, edges, bias;
};
constexpr std::array refinements{Refinement{"cells + bias removed", true, true, true},
                                 Refinement{"cells", true, true, false},
                                 Refinement{"edges + bias removed", false, true, true},
                                 Refinement{"edges", false, true, false},
                                 Refinement{"corners + bias removed", false, false, true},
                                 Refinement{"corners", false, false, false}};

TrackerSettings settings_of(const MethodName& name) {
  TrackerSettings settings;
  settings.decimate = name.decimate;
  settings.region_of_interest = name.region_of_interest;
  for (const Refinement& refinement : refinements)
    if (refinement.name == name.refinement) {
      settings.inner_edges = refinement.cells;
      settings.refine_edges = refinement.edges;
      settings.remove_bias = refinement.bias;
    }
  return settings;
}

void add_ours(std::vector<MethodName>& methods, double decimate) {
  for (const Refinement& refinement : refinements)
    methods.push_back({std::string(ours), std::string(refinement.name), decimate, true});
  methods.push_back({std::string(ours), std::string(refinements[0].name), decimate, false});
}
}  // namespace

TrackingMethod make_method(const MethodName& name, const Apparatus& apparatus) {
  if (name.detector == ours) {
    const auto tracker = std::make_shared<Tracker>(apparatus, settings_of(name));
    return {[tracker](const Image& image, double t_s) -> MethodPoses {
              const TrackedPicture seen = tracker->track(image, t_s);
              return {seen.camera_from_board, seen.board_from_effector, seen.quality,
                      seen.n_effector_faces, seen.effector_t_s};
            },
            [tracker] { tracker->reset(); }};
  }
  const std::shared_ptr<ComparisonTracker> tracker =
      entry_named("comparison", name.detector, comparison_trackers())
          .make(apparatus, name.decimate);
  return {[tracker](const Image& image, double) {
            const ComparisonPoses seen = tracker->track(image);
            MethodPoses poses{seen.camera_from_board, std::nullopt};
            if (seen.camera_from_board && seen.camera_from_effector)
              poses.board_from_effector =
                  seen.camera_from_board->inverse() * *seen.camera_from_effector;
            return poses;
          },
          [] {}};
}

MethodName our_method(int width_px) {
  return {std::string(ours), std::string(refinements[0].name), width_px <= 640 ? 1.0 : 1.5, true};
}

MethodName plain_method(int width_px) {
  return {std::string(plain), "corners", width_px <= 640 ? 1.5 : 2.0, false};
}

std::vector<MethodName> all_methods(int width_px, bool quick) {
  std::vector<MethodName> methods;
  if (quick) return {our_method(width_px), plain_method(width_px)};
  for (const double decimate : decimations) add_ours(methods, decimate);
  for (const ComparisonEntry& entry : comparison_trackers())
    for (const double decimate : decimations)
      if (entry.can_decimate || decimate == 1)
        methods.push_back({std::string(entry.name), "corners", decimate, false});
  return methods;
}

}  // namespace heft
