// Files of the synthetic camera: how its optics and its sensor fall short of a perfect camera's.
// Size, focal length and distortion are the calibration's, as a real camera's are.
#pragma once

#include <string>

#include "tracking/SyntheticCamera.h"

namespace heft {

/// Absent keys are as protocols/apparatus/synthetic_camera.toml explains them.
/// @param text contents  @param file its name, for messages
/// @throws InvalidFile with every mistake at its line and column
SyntheticSettings parse_synthetic_camera(const std::string& text, const std::string& file);

/// What the camera is like, for people: "exposure 4 ms, blur 0.6 px, noise 3 levels, sRGB".
std::string described(const Optics& optics);

}  // namespace heft
