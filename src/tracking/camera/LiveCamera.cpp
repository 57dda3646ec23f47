#include "tracking/camera/LiveCamera.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <utility>

#include "base/Error.h"

namespace heft {

namespace {
bool equal(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.pixels == b.pixels;
}
}  // namespace

LiveCamera::LiveCamera(Grab grab, CameraMode mode, double pause_s)
    : grab_(std::move(grab)),
      mode_(std::move(mode)),
      pause_s_(pause_s),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

// An exception must not leave the thread, which would end the program.
void LiveCamera::run(const std::stop_token& stop) {
  std::string failure;
  try {
    return grab_until(stop);
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (...) {
    failure = "for an unknown reason";
  }
  {
    const std::scoped_lock lock(mutex_);
    failure_ = failure;
  }
  changed_.notify_all();
}

void LiveCamera::grab_until(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::optional<GrabbedPicture> picture = grab_();
    if (picture) {
      keep(std::move(*picture));
      continue;
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, std::chrono::duration<double>(pause_s_), [] { return false; });
  }
}

void LiveCamera::keep(GrabbedPicture picture) {
  if (equal(picture.image, last_)) return;
  last_ = picture.image;
  {
    const std::scoped_lock lock(mutex_);
    newest_ = {std::move(picture.image), picture.capture_s, n_kept_++, ""};
  }
  changed_.notify_all();
}

std::optional<CameraPicture> LiveCamera::next(double timeout_s) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                    [this] { return newest_.has_value() || !failure_.empty(); });
  if (!newest_ && !failure_.empty())
    throw Error(fmt::format("the camera failed and delivers no more pictures: {}", failure_),
                ExitCode::device_missing);
  return std::exchange(newest_, std::nullopt);
}

}  // namespace heft
