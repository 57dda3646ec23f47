#include "record/stream/EventSink.h"

namespace heft {

void RecordedSession::append(const Event& event, const Changes& changes, Durability) {
  entries_.push_back(RecordedEvent{event, changes});
}

void RecordedSession::add_frame(const FrameRow& frame) {
  entries_.push_back(frame);
}

void RecordedSession::add_info(const std::string& key, const std::string& value) {
  header_.participant_info[key] = value;
}

}  // namespace heft
