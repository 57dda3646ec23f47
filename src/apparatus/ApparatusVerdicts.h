// The verdicts of ApparatusCheck.h, each from what was seen of a row of pictures (never none).
#pragma once

#include <vector>

#include "apparatus/ApparatusCheck.h"

namespace heft {

using Pictures = std::vector<LookedAt>;

/// Exposure, focus, white balance: a result each.
std::vector<CheckResult> lock_verdicts(const CameraMode& mode);
CheckResult rate_verdict(const Pictures& pictures, double wanted_rate_hz);
CheckResult light_verdict(const Pictures& pictures);
/// @param name of the result  @param what the body is called in messages
CheckResult print_scale_verdict(const MarkerBody& body, const char* name, const char* what);
CheckResult board_verdict(const Pictures& pictures, const MarkerBody& board);
CheckResult jitter_verdict(const Pictures& pictures);
CheckResult effector_verdict(const Pictures& pictures);
/// Of every stage from the camera to the drawn picture.
CheckResult latency_verdict(const Pictures& pictures);
CheckResult speed_verdict(const Pictures& pictures, const Intrinsics& camera,
                          double wanted_rate_hz);

}  // namespace heft
