#include "session/PictureRecording.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/Error.h"
#include "tracking/ImageFile.h"

namespace heft {

PictureRecording::PictureRecording(const std::string& folder) : folder_(folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  const std::string times = folder + "/times.csv";
  if (std::filesystem::exists(times))
    throw Error(
        fmt::format("{} holds a recording already; choose another folder for "
                    "--record-camera",
                    folder));
  times_.open(times);
  times_ << "frame,t_s\n" << std::flush;
  if (!times_) throw Error(fmt::format("nothing can be written in {}", folder));
}

void PictureRecording::keep(const Image& image, double capture_s) {
  const std::string name = fmt::format("picture_{:06}.png", ++count_);
  write_image(folder_ + "/" + name, image);
  times_ << fmt::format("{},{}\n", name, capture_s) << std::flush;
  if (!times_)
    throw Error(fmt::format("{}/times.csv can't be written; is the disk full?", folder_));
}

}  // namespace heft
