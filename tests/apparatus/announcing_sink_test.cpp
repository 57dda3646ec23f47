// Events are sent in order once they are on disk, and never if the log refused them. Buffered
// events, such as contacts, are also sent immediately, marked as not logged.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "apparatus/EventOutlet.h"
#include "base/Error.h"

namespace heft {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class MadeUpLog final : public EventSink {
 public:
  void append(const Event&, const Changes&, Durability) override {
    if (busy) throw LogBusy("locked");
    if (broken) throw Error("the disk is full");
  }
  void add_frame(const FrameRow&) override {}
  void add_info(const std::string&, const std::string&) override {}
  void flush() override {
    if (busy) throw LogBusy("locked");
  }

  bool busy = false, broken = false;
};

class AnnouncedEvents : public testing::Test {
 protected:
  AnnouncedEvents() {
    if (!mkdtemp(folder_.data())) throw std::runtime_error("no folder");
    pipe_ = folder_ + "/pipe";
    mkfifo(pipe_.c_str(), 0600);
  }
  ~AnnouncedEvents() override {
    if (reader_ >= 0) close(reader_);
    std::filesystem::remove_all(folder_);
  }

  void listen() { reader_ = open(pipe_.c_str(), O_RDONLY | O_NONBLOCK); }
  std::string heard() const {
    char bytes[65536];
    const ssize_t n = read(reader_, bytes, sizeof bytes);
    return n > 0 ? std::string(bytes, static_cast<std::size_t>(n)) : "";
  }
  void note(const std::string& text, Durability durability) {
    sink().append({1.5, Note{text}}, {}, durability);
  }
  AnnouncingSink& sink() {
    if (!sink_) {
      outlet_.emplace(parse_event_target("fifo:" + pipe_));
      sink_.emplace(log_, *outlet_, 7, "P\"07");
    }
    return *sink_;
  }

  MadeUpLog log_;
  std::optional<EventOutlet> outlet_;

 private:
  std::string folder_ = testing::TempDir() + "heft-events-XXXXXX", pipe_;
  std::optional<AnnouncingSink> sink_;
  int reader_ = -1;
};

TEST_F(AnnouncedEvents, AreALineEachOnceTheyAreOnDisk) {
  listen();
  note("one", Durability::buffered);
  const std::string at_once = heard();
  EXPECT_EQ(std::ranges::count(at_once, '\n'), 1);
  EXPECT_THAT(at_once,
              HasSubstr(R"("participant":"P\"07","kind":"note","detail":"one","logged":false})"));
  note("two", Durability::acknowledged);
  const std::string both = heard();
  EXPECT_EQ(std::ranges::count(both, '\n'), 2);
  EXPECT_LT(both.find("one"), both.find("two"));
  EXPECT_THAT(both, HasSubstr(R"("detail":"one","logged":true})"));
  EXPECT_THAT(both,
              HasSubstr(R"("session":7,"participant":"P\"07","kind":"note","detail":"two"})"));
  note("three", Durability::buffered);
  sink().flush();
  EXPECT_THAT(heard(),
              AllOf(HasSubstr(R"("three","logged":false)"), HasSubstr(R"("three","logged":true)")));
  sink().announce_head(2, "1a2b");
  EXPECT_THAT(heard(), HasSubstr(R"("kind":"sealed","head":"1a2b"})"));
}

// A reset that a person asks for is on disk before the cubes move.
TEST_F(AnnouncedEvents, ResetsAreSentBeforeTheyAreOnDisk) {
  listen();
  log_.busy = true;
  EXPECT_THROW(sink().append({1.5, CubesReset{}}, {}, Durability::acknowledged), LogBusy);
  EXPECT_THAT(heard(), HasSubstr(R"("logged":false})"));
  log_.busy = false;
  sink().flush();
  EXPECT_THAT(heard(), HasSubstr(R"("logged":true})"));
}

TEST_F(AnnouncedEvents, ThatTheLogKeepsForLaterAreSentThen) {
  listen();
  log_.busy = true;
  EXPECT_THROW(note("kept", Durability::acknowledged), LogBusy);
  EXPECT_EQ(heard(), "");
  log_.busy = false;
  sink().flush();
  EXPECT_THAT(heard(), HasSubstr("kept"));
}

TEST_F(AnnouncedEvents, ThatTheLogRefusedHaveNeverBeen) {
  listen();
  log_.broken = true;
  EXPECT_THROW(note("lost", Durability::acknowledged), Error);
  log_.broken = false;
  note("next", Durability::acknowledged);
  EXPECT_EQ(heard().find("lost"), std::string::npos);
}

TEST_F(AnnouncedEvents, AreCountedWhereNoOneListens) {
  note("alone", Durability::acknowledged);
  EXPECT_EQ(outlet_->n_dropped(), 1);
  listen();
  note("heard", Durability::acknowledged);
  EXPECT_THAT(heard(), HasSubstr("heard"));
  EXPECT_EQ(outlet_->n_dropped(), 1);
  EXPECT_EQ(outlet_->n_sent(), 1);
}

TEST_F(AnnouncedEvents, AreShortWhateverIsInThem) {
  listen();
  note(std::string(100000, '\x01'), Durability::acknowledged);
  const std::string line = heard();
  EXPECT_THAT(line, HasSubstr("\\u0001"));
  EXPECT_LT(line.size(), 4096u);
}

TEST_F(AnnouncedEvents, KeepTheBeginningOfALongDetail) {
  listen();
  note(std::string(300, 'x'), Durability::acknowledged);
  EXPECT_THAT(heard(), HasSubstr('"' + std::string(240, 'x') + '"'));
}

TEST_F(AnnouncedEvents, ThatFillThePipeStopNoOne) {
  listen();
  for (int i = 0; i < 2000; ++i) note(std::string(200, 'x'), Durability::acknowledged);
  EXPECT_GT(outlet_->n_dropped(), 0);
  EXPECT_EQ(outlet_->n_dropped() + outlet_->n_sent(), 2000);
  std::string all;
  for (std::string some = heard(); !some.empty(); some = heard()) all += some;
  EXPECT_EQ(std::ranges::count(all, '\n'), outlet_->n_sent());
  EXPECT_EQ(all.back(), '\n');
}

}  // namespace
}  // namespace heft
