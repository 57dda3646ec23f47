#include "protocol/SyntheticCameraFile.h"

#include <fmt/format.h>

#include "protocol/TableReader.h"

namespace heft {

namespace {
constexpr Range exposures_s{0, 0.05};
constexpr Range readouts_s{0, 0.05};
constexpr Range blurs_px{0, 10};  // much more, and nothing is rendered in useful time
constexpr Range gammas{1, 3};
constexpr Range shares_lost{0, 1, false, true};
constexpr Range lights{0, 10, true};
constexpr Range noises{0, 100};
}  // namespace

SyntheticSettings parse_synthetic_camera(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  SyntheticSettings settings;
  Optics& optics = settings.optics;
  reader.read("exposure_s", optics.exposure_s, exposures_s);
  reader.read("readout_s", optics.readout_s, readouts_s);
  reader.read("blur_px", optics.blur_px, blurs_px);
  reader.read("vignetting", optics.vignetting, shares_lost);
  reader.read("light", optics.exposure, lights);
  reader.read("gamma", optics.gamma, gammas);
  reader.read("noise_levels", optics.noise, noises);
  reader.read("hand", settings.hand);
  reader.close();
  mistakes.throw_if_any();
  return settings;
}

std::string described(const Optics& optics) {
  const std::string readout =
      optics.readout_s > 0 ? fmt::format("read-out {:g} ms, ", 1e3 * optics.readout_s) : "";
  return fmt::format("exposure {:g} ms, {}blur {:g} px, noise {:g} levels, {}",
                     1e3 * optics.exposure_s, readout, optics.blur_px, optics.noise,
                     optics.gamma ? fmt::format("gamma {:g}", *optics.gamma) : "sRGB");
}

}  // namespace heft
