#include "session/PictureSource.h"

namespace heft {

void HandPictures::begin_attempt() {
  count_ = 0;
  last_ = {};
  last_.tracked = false;
}

Picture HandPictures::next() {
  Picture picture;
  TargetSample& sample = picture.sample;
  sample.t_capture_s = count_++ / rate_hz_;  // no accumulated rounding
  const HandSample hand = responder_.hand(sample.t_capture_s);
  sample.pose = hand.pose;
  sample.tracked = hand.in_view;
  if (sample.tracked && last_.tracked)
    sample.velocity =
        mean_velocity(last_.pose, sample.pose, sample.t_capture_s - last_.t_capture_s);
  last_ = sample;
  return picture;
}

}  // namespace heft
