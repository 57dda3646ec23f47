// Takes pictures from a camera as they come and keeps the newest one. Drivers queue about four
// pictures; whoever reads only when there is time sees the past.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "tracking/Camera.h"

namespace heft {

struct GrabbedPicture {
  Image image;
  double capture_s = 0;
};

class GrabThread {
 public:
  /// Waits for the device's next picture. None: it gives no pictures at present, try again; it must
  /// come back within about a second, or the thread can't be ended.
  using Grab = std::function<std::optional<GrabbedPicture>()>;

  /// @param grab is called on the thread only  @param pause_s after a grab without a picture
  explicit GrabThread(Grab grab, double pause_s = 0.2);

  /// The newest picture that was not given yet; waits for it. None after timeout_s. A picture that
  /// equals the one before it in every byte is none: real sensors have noise, so it tells that the
  /// camera is frozen.
  /// @throws Error when grab has thrown, after the last picture before: it is not asked again
  std::optional<CameraPicture> next(double timeout_s);

 private:
  void run(const std::stop_token& stop);
  void grab_until(const std::stop_token& stop);
  void keep(GrabbedPicture picture);

  Grab grab_;
  double pause_s_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<CameraPicture> newest_;  ///< not given yet
  std::string failure_;                  ///< what grab has thrown, if anything
  std::int64_t n_kept_ = 0;
  Image last_;           ///< of the thread alone
  std::jthread thread_;  ///< last: it uses all others
};

}  // namespace heft
