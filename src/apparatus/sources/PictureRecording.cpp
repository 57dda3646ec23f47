#include "apparatus/sources/PictureRecording.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/pose/PoseColumns.h"

namespace heft {

PictureRecording::PictureRecording(const std::string& folder) : folder_(folder) {
  std::error_code problem;
  if (std::filesystem::create_directories(folder, problem))
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, problem);
  const std::string times = folder + "/times.csv";
  if (std::filesystem::exists(times))
    throw Error(
        fmt::format("{} already holds a recording; choose another folder for "
                    "--record-camera",
                    folder));
  times_ = begun(times, "frame,t_s");
}

std::ofstream PictureRecording::begun(const std::string& file, const std::string& header) const {
  if (!create_file(file, 0600)) throw Error(fmt::format("{} already exists", file));
  std::ofstream out(file);
  out << header << "\n" << std::flush;
  if (!out) throw Error(fmt::format("cannot write in {}", folder_));
  return out;
}

void PictureRecording::keep(const Image& image, double capture_s) {
  const std::string name = fmt::format("picture_{:06}.png", ++count_);
  if (!create_file(folder_ + "/" + name, 0600))
    throw Error(fmt::format("{}/{} already exists and is not overwritten", folder_, name));
  write_image(folder_ + "/" + name, image);
  times_ << fmt::format("{},{}\n", name, capture_s) << std::flush;
  if (!times_) throw Error(fmt::format("cannot write {}/times.csv; is the disk full?", folder_));
}

void PictureRecording::keep(const Image& image, double capture_s, const RenderedPoses& truth) {
  if (count_ == 0)
    truth_ = begun(folder_ + "/truth.csv", fmt::format("frame,t_s,{}", pose_columns));
  keep(image, capture_s);
  truth_ << fmt::format("{},{},{}\n", count_ - 1, capture_s,
                        pose_cells(truth.board_from_effector, truth.camera_from_board))
         << std::flush;
  if (!truth_) throw Error(fmt::format("cannot write {}/truth.csv; is the disk full?", folder_));
}

}  // namespace heft
