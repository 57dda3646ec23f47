// A V4L2 camera through OpenCV.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/videoio.hpp>

#include "base/Clock.h"
#include "base/Error.h"
#include "tracking/camera/Camera.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/camera/LiveCamera.h"
#include "tracking/camera/VideoDevices.h"
#include "tracking/codecs/Codecs.h"

namespace heft {

namespace {
constexpr double driver_exposure_s = 1e-4;  // V4L2 counts exposure in units of 100 microseconds
constexpr double manual_exposure = 1;       // V4L2_EXPOSURE_MANUAL
constexpr double first_picture_s = 5;       // some cameras take long to start

// The four letters of a pixel format.
std::string letters_of(double code) {
  const auto bits = static_cast<std::uint32_t>(code > 0 ? code : 0);
  std::string letters;
  for (int i = 0; i < 4; ++i)
    if (const auto letter = static_cast<char>(bits >> (8 * i) & 0xff); letter > ' ')
      letters += letter;
  return letters;
}

// Uncompressed if USB 2 has the bandwidth: JPEG's blocks disturb edges.
double wanted_format(const CameraRequest& request) {
  const bool fits = request.width_px * request.height_px * request.rate_hz <= 640 * 480 * 30;
  return four_cc(fits ? std::array{'Y', 'U', 'Y', 'V'} : std::array{'M', 'J', 'P', 'G'});
}

bool takes(const CameraControls& controls, int property, double value) {
  return controls.set(property, value) && std::abs(controls.get(property) - value) < 0.5;
}

constexpr std::string_view exposure_drifts =
    "exposure: chosen by the camera, so it is long in dim light and fast movements are blurred; "
    "add "
    "light";
constexpr std::string_view focus_moves =
    "focus: if the lens refocuses, the calibration no longer holds; cameras without autofocus are "
    "fine";

void lock_exposure(const CameraControls& controls, double exposure_s, CameraMode& mode) {
  const double wanted = std::max(1.0, std::round(exposure_s / driver_exposure_s));
  const bool manual = takes(controls, cv::CAP_PROP_AUTO_EXPOSURE, manual_exposure);
  const bool set = manual && controls.set(cv::CAP_PROP_EXPOSURE, wanted);
  const double got_s = controls.get(cv::CAP_PROP_EXPOSURE) * driver_exposure_s;
  if (!manual)
    mode.not_locked.emplace_back(exposure_drifts);
  else if (!set || got_s > 1.5 * exposure_s)
    mode.not_locked.push_back(
        fmt::format("exposure: fixed at {:.1f} ms instead of {:.1f} ms, so "
                    "fast movements are more blurred",
                    1e3 * got_s, 1e3 * exposure_s));
  else
    mode.held.exposure_s = got_s;
  if (mode.held.exposure_s) mode.locked.push_back(fmt::format("exposure {:.1f} ms", 1e3 * got_s));
}

// The lens's position affects the focal length.
void lock_focus(const CameraControls& controls, std::optional<double> wanted, CameraMode& mode) {
  const bool still = takes(controls, cv::CAP_PROP_AUTOFOCUS, 0);
  if (wanted && !takes(controls, cv::CAP_PROP_FOCUS, *wanted)) {
    const double at = controls.get(cv::CAP_PROP_FOCUS);
    mode.not_locked.push_back(fmt::format(
        "focus: calibrated at {:g}, but {}, so the calibration may be wrong: calibrate again",
        *wanted,
        at < 0 ? std::string("this driver cannot set it")
               : fmt::format("it is at {:g} and the driver does not change it", at)));
  } else if (!still) {
    mode.not_locked.emplace_back(focus_moves);
  } else {
    // Setting the current position locks the lens there, and fails if the driver lacks the control.
    const double at = controls.get(cv::CAP_PROP_FOCUS);
    if (at >= 0 && takes(controls, cv::CAP_PROP_FOCUS, at)) mode.held.focus = at;
    mode.locked.push_back(mode.held.focus ? fmt::format("focus {:g}", at) : "focus");
  }
}
}  // namespace

double capture_time_s(double driver_s, double arrival_s, double exposure_s) {
  const bool believable = driver_s <= arrival_s && driver_s > arrival_s - 1;
  return (believable ? driver_s : arrival_s) - exposure_s / 2;
}

void lock_controls(const CameraControls& controls, const CameraRequest& request, CameraMode& mode) {
  lock_exposure(controls, request.exposure_s, mode);
  lock_focus(controls, request.focus, mode);
  if (takes(controls, cv::CAP_PROP_AUTO_WB, 0))
    mode.locked.push_back("white balance");
  else
    mode.not_locked.emplace_back("white balance: colors may drift, which does not affect tracking");
}

namespace {

// The device; after construction only the grabbing thread uses it.
class Device {
 public:
  Device(int number, const CameraRequest& request) : number_(number), request_(request) { open(); }

  bool is_open() const { return capture_->isOpened(); }
  CameraMode mode();

  // An unplugged device is reopened when it is back.
  std::optional<GrabbedPicture> grab() {
    cv::Mat picture;
    if (!is_open() || !capture_->read(picture) || picture.empty()) {
      capture_->release();
      open();
      return std::nullopt;
    }
    const double arrival_s = monotonic_s();
    const double driver_s = capture_->get(cv::CAP_PROP_POS_MSEC) / 1e3;
    return GrabbedPicture{image_from(picture), capture_time_s(driver_s, arrival_s, exposure_s_)};
  }

 private:
  void open();

  int number_;
  CameraRequest request_;
  std::unique_ptr<cv::VideoCapture> capture_ = codecs().capture();
  CameraMode locks_;
  double exposure_s_ = 0;
};

void Device::open() {
  try {
    check_device(number_);
  } catch (const Error&) {
    return;  // missing at present
  }
  if (!capture_->open(number_, cv::CAP_V4L2)) return;
  capture_->set(cv::CAP_PROP_FOURCC, wanted_format(request_));
  capture_->set(cv::CAP_PROP_FRAME_WIDTH, request_.width_px);
  capture_->set(cv::CAP_PROP_FRAME_HEIGHT, request_.height_px);
  capture_->set(cv::CAP_PROP_FPS, request_.rate_hz);
  locks_ = {};
  lock_controls({[this](int property, double value) { return capture_->set(property, value); },
                 [this](int property) { return capture_->get(property); }},
                request_, locks_);
  lock_driver_controls(fmt::format("/dev/video{}", number_), locks_);
  const double said_s = capture_->get(cv::CAP_PROP_EXPOSURE) * driver_exposure_s;
  exposure_s_ = said_s > 0 && said_s < 0.1 ? said_s : request_.exposure_s;
}

CameraMode Device::mode() {
  CameraMode mode = locks_;
  mode.width_px = static_cast<int>(capture_->get(cv::CAP_PROP_FRAME_WIDTH));
  mode.height_px = static_cast<int>(capture_->get(cv::CAP_PROP_FRAME_HEIGHT));
  mode.rate_hz = capture_->get(cv::CAP_PROP_FPS);
  mode.pixel_format = letters_of(capture_->get(cv::CAP_PROP_FOURCC));
  return mode;
}

}  // namespace

std::unique_ptr<Camera> open_live_camera(const std::string& number, const CameraRequest& request) {
  const int n = device_number(number);
  check_device(n);
  // OpenCV waits 10 s for a frozen camera by default, which would delay the program's end.
  setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1", 0);
  const auto device = std::make_shared<Device>(n, request);
  if (!device->is_open())
    throw Error(
        fmt::format("the camera /dev/video{} cannot be opened: another program may be using "
                    "it, or it is not a camera (many have a second device for metadata); "
                    "cameras here: {}",
                    n, list_of(video_devices())),
        ExitCode::device_missing);
  auto camera = std::make_unique<LiveCamera>([device] { return device->grab(); }, device->mode());
  if (!camera->next(first_picture_s))
    throw Error(
        fmt::format("the camera /dev/video{} exists but delivers no pictures within {:.0f} s: "
                    "unplug it and plug it in again, perhaps on another port",
                    n, first_picture_s),
        ExitCode::device_missing);
  return camera;
}

}  // namespace heft
