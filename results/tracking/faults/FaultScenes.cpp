// What is wrong with cameras, their light and their prints, one thing at a time.
#include "results/tracking/faults/FaultStudy.h"

namespace heft {

namespace {
using S = FaultScene;

Fault fault(const char* name, const char* label, std::vector<double> values,
            std::function<void(FaultScene&, double)> change) {
  return {name, label, std::move(values), std::move(change)};
}

void roll(FaultScene& scene, double readout_s, double speed_m_s) {
  scene.apparatus.camera.readout_s = scene.settings.optics.readout_s = readout_s;
  scene.speed_m_s = speed_m_s;
}

double more_by(double percent) {
  return 1 + percent / 100;
}
}  // namespace

std::vector<Fault> faults() {
  return {
      fault("film", "film curve (share; the rest: sRGB)", {0, 0.5, 1},
            [](S& s, double share) { s.settings.optics.film_curve = share; }),
      fault("s_curve", "S-curve (strength)", {0, 0.3, 0.6},
            [](S& s, double strength) { s.settings.optics.s_curve = strength; }),
      fault("sharpening", "sharpening (of what 1 px of blur takes)", {0, 0.5, 1, 1.5},
            [](S& s, double strength) { s.settings.optics.sharpening = strength; }),
      fault(
          "jpeg", "JPEG (100 - quality)", {5, 10, 20, 40},
          [](S& s, double lost) { s.settings.optics.jpeg_quality = 100 - static_cast<int>(lost); }),
      fault("mosaic_jpeg", "Bayer mosaic and JPEG (100 - quality)", {5, 10, 20, 40},
            [](S& s, double lost) {
              s.settings.optics.mosaic = true;
              s.settings.optics.jpeg_quality = 100 - static_cast<int>(lost);
            }),
      fault("shadow", "a shadow's edge over the effector (light it takes)", {0, 0.2, 0.4, 0.6},
            [](S& s, double taken) { s.settings.optics.shadow = taken; }),
      fault("glare", "glare on the effector (1: white)", {0, 0.1, 0.2, 0.4},
            [](S& s, double light) { s.settings.optics.glare = light; }),
      fault("defocus", "blur by lens and focus (px, SD)", {0.6, 0.9, 1.2, 1.5},
            [](S& s, double sd_px) { s.settings.optics.blur_px = sd_px; }),
      fault("noise", "noise (gray levels, SD)", {3, 6, 10, 15},
            [](S& s, double sd) { s.settings.optics.noise = sd; }),
      fault("dim_noise", "dim (share of the light that is missing), noise 10", {0, 0.5, 0.7, 0.85},
            [](S& s, double missing) {
              s.settings.optics.exposure = 1 - missing;
              s.settings.optics.noise = 10;
            }),
      fault("rolling_10ms", "rolling shutter, 10 ms (m/s)", {0, 0.1, 0.25, 0.5},
            [](S& s, double speed) { roll(s, 0.010, speed); }),
      fault("rolling_25ms", "rolling shutter, 25 ms (m/s)", {0, 0.1, 0.25, 0.5},
            [](S& s, double speed) { roll(s, 0.025, speed); }),
      fault("last_picture", "temporal denoising (share of the last picture), 0.25 m/s",
            {0, 0.15, 0.3, 0.45},
            [](S& s, double share) {
              s.settings.optics.last_picture = share;
              s.speed_m_s = 0.25;
            }),
      fault("breathing", "focus breathing (%)", {0, 0.2, 0.4, 0.8},
            [](S& s, double percent) { s.settings.optics.breathing = percent / 100; }),
      fault("auto_gain", "automatic gain (amplitude), 0.25 m/s", {0, 0.2, 0.4},
            [](S& s, double share) {
              s.settings.optics.auto_gain = share;
              s.speed_m_s = 0.25;
            }),
      fault("auto_white_balance", "automatic white balance (amplitude)", {0, 0.1, 0.3},
            [](S& s, double share) { s.settings.optics.auto_white_balance = share; }),
      fault("flicker", "flicker at 100 Hz, rolling shutter 25 ms (amplitude)", {0, 0.1, 0.3},
            [](S& s, double share) {
              s.settings.optics.flicker = share;
              roll(s, 0.025, 0);
            }),
      fault("repeated", "repeated pictures (share), 0.25 m/s", {0, 0.2, 0.4},
            [](S& s, double share) {
              s.settings.optics.repeated = share;
              roll(s, 0.025, 0.25);
            }),
      fault("dropped", "dropped pictures (share), 0.25 m/s", {0, 0.2, 0.4},
            [](S& s, double share) {
              s.settings.optics.dropped = share;
              roll(s, 0.025, 0.25);
            }),
      fault("untimed_drops", "dropped without times (share), 0.25 m/s", {0, 0.2, 0.4},
            [](S& s, double share) {
              s.settings.optics.dropped = share;
              s.has_times = false;
              roll(s, 0.025, 0.25);
            }),
      fault("effector_print", "effector's tags printed too large (%)", {0, 0.2, 0.5, 1},
            [](S& s, double percent) { s.settings.files.effector_tag_scale = more_by(percent); }),
      fault("board_print", "board's tags printed too large (%)", {0, 0.2, 0.5, 1},
            [](S& s, double percent) { s.settings.files.board_tag_scale = more_by(percent); }),
      fault("focal_length", "camera file's focal length too long (%)", {0, 0.2, 0.5, 1},
            [](S& s, double percent) {
              s.settings.files.focal_length_scale = 1 / more_by(percent);
            })};
}

}  // namespace heft
