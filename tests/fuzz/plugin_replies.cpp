// The input is what a driver answers: its description of the device, then frames. What is delivered
// is recorded, and read again as the same. The driver keeps the interface's one rule that nobody
// can check: what its pointers name is as large as it says.

#include <algorithm>
#include <array>
#include <cstring>
#include <turnscan/capture/source/plugin_source.hpp>
#include <turnscan/recording/recording.hpp>

#include "tests/fuzz/scratch_folder.hpp"

namespace {

using namespace turnscan;

/// Takes values from the front of the input; zeros behind its end.
class Replies {
 public:
  Replies(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  template <class T>
  T next() {
    T value{};
    const std::size_t count = std::min(sizeof value, size_ - at_);
    std::memcpy(static_cast<void*>(&value), data_ + at_, count);
    at_ += count;
    return value;
  }
  bool more() const { return at_ < size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

constexpr std::int32_t kLargest = 16;  // of an image in pixels
std::array<std::uint16_t, 2 * kLargest * kLargest> g_depth;
std::array<std::uint8_t, 3 * kLargest * kLargest> g_color;
Replies g_replies(nullptr, 0);

/// Mostly the size of the camera; sometimes none, or another one.
std::int32_t side(std::int32_t usual) {
  const auto choice = g_replies.next<std::uint8_t>();
  return choice < 200 ? usual : std::int32_t(choice % (kLargest + 2)) - 1;
}

std::int32_t list(turnscan_device_entry*, std::int32_t, turnscan_error*) { return 0; }

std::int32_t open_it(const char*, const turnscan_parameter*, std::int32_t, turnscan_device** device,
                     turnscan_error*) {
  static int there = 0;
  *device = reinterpret_cast<turnscan_device*>(&there);
  return TURNSCAN_OK;
}

std::int32_t describe_it(turnscan_device*, turnscan_device_info* info, turnscan_error* error) {
  *info = g_replies.next<turnscan_device_info>();
  std::memset(error->text, 'x', sizeof error->text);
  for (turnscan_camera* camera : {&info->camera, &info->color_camera}) {
    camera->width = 1 + std::abs(camera->width % kLargest);
    camera->height = 1 + std::abs(camera->height % kLargest);
  }
  return g_replies.next<std::uint8_t>() == 255 ? TURNSCAN_FAILED : TURNSCAN_OK;
}

std::int32_t start_it(turnscan_device*, turnscan_error*) { return TURNSCAN_OK; }
void stop_it(turnscan_device*) {}

std::int32_t grab_it(turnscan_device*, double, turnscan_frame* frame, turnscan_error*) {
  if (!g_replies.more()) return TURNSCAN_END;
  const auto kind = g_replies.next<std::uint8_t>();
  if (kind == 255) return g_replies.next<std::int32_t>();
  g_depth.fill(g_replies.next<std::uint16_t>());
  g_color.fill(kind);
  frame->depth = kind == 254 ? nullptr : g_depth.data();
  frame->width = side(8);
  frame->height = side(6);
  frame->color = kind % 2 == 0 ? g_color.data() : nullptr;
  frame->color_width = side(8);
  frame->color_height = side(6);
  frame->time_s = kind < 128 ? kind / 30.0 : g_replies.next<double>();
  frame->number = kind < 64 ? 0 : g_replies.next<std::uint64_t>();
  return TURNSCAN_OK;
}

constexpr turnscan_plugin kDriver{TURNSCAN_PLUGIN_VERSION,
                                  "fuzz",
                                  "fuzzed",
                                  nullptr,
                                  0,
                                  list,
                                  open_it,
                                  describe_it,
                                  start_it,
                                  grab_it,
                                  stop_it,
                                  stop_it};

constexpr int kMaxFrames = 12;

/// The frames that the recording took.
std::vector<Frame> record(source::Grabber& device, RecordingWriter& writer) {
  std::vector<Frame> taken;
  for (std::uint32_t i = 0; i < kMaxFrames; ++i) {
    auto delivery = device.grab(0.01);
    if (!delivery || delivery->kind == Delivery::Kind::kEnd) break;
    if (delivery->kind != Delivery::Kind::kFrame) continue;
    delivery->frame.info.index = i;
    if (writer.append(delivery->frame)) taken.push_back(std::move(delivery->frame));
  }
  return taken;
}

void check_same(const Recording& recording, const std::vector<Frame>& taken) {
  fuzz::require(recording.frames().size() == taken.size(), "every frame that was taken");
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i].info.status == FrameStatus::kDropped) continue;
    const auto frame = recording.read(i);
    fuzz::require(frame && frame->depth.pixels == taken[i].depth.pixels, "the same depth");
    fuzz::require(frame->color.pixels.size() == taken[i].color.pixels.size(), "the same colour");
  }
}

}  // namespace

TURNSCAN_FUZZ_TARGET(plugin_replies) {
  static const fuzz::ScratchFolder folder;
  std::error_code error;
  std::filesystem::remove_all(folder / "r", error);
  g_replies = Replies(data, size);
  auto device = source::open_device(kDriver, {"fuzz", "", {}});
  if (!device || !(*device)->start()) return 0;
  const SourceInfo& info = (*device)->info();
  auto writer = RecordingWriter::create(folder / "r", info.header, info.settings);
  if (!writer) return 0;
  const std::vector<Frame> taken = record(**device, *writer);
  fuzz::require(bool(writer->finish()), "it is finished");
  const auto recording = Recording::open(folder / "r");
  fuzz::require(bool(recording), "what was recorded opens");
  check_same(*recording, taken);
  return 0;
}
