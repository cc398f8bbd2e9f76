#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <tuple>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/import_ros/bag_sequence.hpp>
#include <turnscan/io/import_ros/ros_images.hpp>

namespace turnscan::importers {

namespace {

using rosbag::Bag;
using rosbag::MessagePlace;

constexpr std::size_t kHeaderBytes = 512;   // contain a message's header
constexpr std::int64_t kLongestGap = 1000;  // frames; a larger one starts a new sequence
constexpr double kNear = 0.75;              // relative to the frame interval
constexpr double kNearest_s = 0.02;         // always counts as near
// Relative to the frame interval; a larger gap means that frames are missing.
constexpr double kGap = 1.6;

constexpr std::uint64_t kFrameHeld = 512;  // bytes that a frame takes, be it a dropped one

struct Shot {
  MessagePlace place;
  std::uint32_t seq = 0;
  std::int64_t stamp_ns = 0;
  bool good = false;
};

/// The messages of two topics with the content of their headers; unreadable ones are not good. In
/// the order of the file, so that each chunk is unpacked once.
Result<std::array<std::vector<Shot>, 2>> shots_of(const Bag& bag, const BagStreams& streams) {
  std::array<std::vector<Shot>, 2> shots;
  std::vector<Shot*> in_file;
  for (const bool color : {false, true}) {
    const std::string& topic = color ? streams.color_topic : streams.depth_topic;
    if (topic.empty()) continue;
    for (const MessagePlace& place : bag.messages(topic)) shots[color].push_back({place});
    for (Shot& shot : shots[color]) in_file.push_back(&shot);
  }
  std::sort(in_file.begin(), in_file.end(), [](const Shot* a, const Shot* b) {
    return std::tie(a->place.file, a->place.chunk, a->place.offset) <
           std::tie(b->place.file, b->place.chunk, b->place.offset);
  });
  parallel_for(in_file.size(), 16, [&](std::size_t i) {
    Shot& shot = *in_file[i];
    if (!bag.budget().state()) return;
    const auto message = bag.read(shot.place, kHeaderBytes);
    if (!message) return;
    const auto header = rosbag::parse_header(message->bytes, message->wire);
    if (!header) return;
    shot.seq = header->seq;
    shot.stamp_ns = header->stamp_ns;
    shot.good = true;
  });
  TURNSCAN_TRY(bag.budget().state());
  return shots;
}

double seconds(std::int64_t ns) { return double(ns) / 1e9; }

/// Whether the headers' times can be used: all are present, and none decreases.
bool stamped(const std::vector<Shot>& shots) {
  for (std::size_t i = 0; i < shots.size(); ++i)
    if (shots[i].stamp_ns <= 0 || (i > 0 && shots[i].stamp_ns < shots[i - 1].stamp_ns))
      return false;
  return true;
}

double median_step_s(const std::vector<std::int64_t>& times_ns) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < times_ns.size(); ++i) steps.push_back(times_ns[i] - times_ns[i - 1]);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return seconds(*middle);
}

/// Whether the sequence numbers count frames: most increase by one, none decreases or jumps very
/// far.
bool counts_frames(const std::vector<Shot>& shots) {
  std::size_t ones = 0;
  for (std::size_t i = 1; i < shots.size(); ++i) {
    const std::int64_t step = std::int64_t(shots[i].seq) - std::int64_t(shots[i - 1].seq);
    if (step < 1 || step > kLongestGap) return false;
    ones += step == 1 ? 1 : 0;
  }
  return shots.size() > 1 && 2 * ones >= shots.size() - 1;
}

/// The number of frames missing before each one, by sequence numbers or else by times.
std::vector<std::int64_t> missing_before(const std::vector<Shot>& shots,
                                         const std::vector<std::int64_t>& times_ns) {
  std::vector<std::int64_t> out(shots.size(), 0);
  const bool counted = counts_frames(shots);
  const double step_s = median_step_s(times_ns);
  for (std::size_t i = 1; i < shots.size(); ++i) {
    if (counted) {
      out[i] = std::int64_t(shots[i].seq) - std::int64_t(shots[i - 1].seq) - 1;
    } else if (step_s > 0.0 && shots.size() > 2) {
      const double steps = seconds(times_ns[i] - times_ns[i - 1]) / step_s;
      if (steps > kGap && steps <= double(kLongestGap)) out[i] = std::llround(steps) - 1;
    }
  }
  return out;
}

struct Timeline {
  std::vector<std::int64_t> depth_ns, color_ns;
};

/// Depth and colour times on the same clock: the headers' if both have one and they overlap, else
/// the recorder's.
Timeline timeline_of(const std::vector<Shot>& depth, const std::vector<Shot>& color,
                     SequenceHeader& header) {
  const bool own = stamped(depth);
  if (!own)
    add_note(header,
             "the times in the frames' headers are missing or run back; the times at which "
             "they were recorded are used");
  const bool shared = own && !color.empty() && stamped(color) &&
                      color.front().stamp_ns <= depth.back().stamp_ns &&
                      depth.front().stamp_ns <= color.back().stamp_ns;
  Timeline out;
  for (const Shot& shot : depth) out.depth_ns.push_back(own ? shot.stamp_ns : shot.place.time_ns);
  // On the recorder's clock, colour times are shifted to those of depth by the first frames of
  // both.
  const std::int64_t moved =
      own && !shared ? depth.front().stamp_ns - depth.front().place.time_ns : 0;
  for (const Shot& shot : color)
    out.color_ns.push_back(shared ? shot.stamp_ns : shot.place.time_ns + moved);
  return out;
}

class BagSequence : public FrameSequence {
 public:
  BagSequence(Bag bag, BagStreams streams, SequenceHeader header)
      : bag_(std::move(bag)), streams_(std::move(streams)), header_(std::move(header)) {}

  Result<> list();
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Places {
    MessagePlace depth;
    std::uint32_t color = kNone;  ///< index into colors_
  };

  Result<> add_frames(const std::vector<Shot>& shots, const std::vector<std::int64_t>& times_ns);
  void match_colors(const std::vector<Shot>& shots, const Timeline& times);
  Result<> look_at_first();
  Result<DepthImage> depth_of(const MessagePlace& place) const;
  Result<> read_color(const MessagePlace& place, Frame& frame) const;

  Bag bag_;
  BagStreams streams_;
  SequenceHeader header_;
  std::vector<FrameInfo> frames_;
  std::vector<Places> places_;  ///< one per frame
  std::vector<MessagePlace> colors_;
};

Result<> BagSequence::list() {
  TURNSCAN_ASSIGN(auto all_shots, shots_of(bag_, streams_));
  auto& [shots, colors] = all_shots;
  const std::size_t all = shots.size();
  std::erase_if(shots, [](const Shot& shot) { return !shot.good; });
  if (shots.empty())
    return fail_at(bag_.path().string(), ErrorCode::kMissingData,
                   "the bag has no whole message of {}; record again", streams_.depth_topic);
  if (shots.size() < all)
    add_note(header_,
             fmt::format("{} of {} frames are damaged and were left out", all - shots.size(), all));
  std::erase_if(colors, [](const Shot& shot) { return !shot.good; });
  const Timeline times = timeline_of(shots, colors, header_);
  TURNSCAN_TRY(add_frames(shots, times.depth_ns));
  match_colors(colors, times);
  if (!bag_.cut().empty())
    add_note(header_,
             fmt::format("the bag was not closed or is damaged ({}); {} whole frames were found",
                         bag_.cut(), shots.size()));
  TURNSCAN_TRY(look_at_first());
  bag_.end_of_opening();
  return {};
}

Result<> BagSequence::add_frames(const std::vector<Shot>& shots,
                                 const std::vector<std::int64_t>& times_ns) {
  const std::vector<std::int64_t> missing = missing_before(shots, times_ns);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const double time_s = seconds(times_ns[i] - times_ns.front());
    TURNSCAN_TRY(bag_.budget().hold(std::uint64_t(missing[i]) * kFrameHeld));
    for (std::int64_t k = 1; k <= missing[i]; ++k) {
      const double before_s = seconds(times_ns[i - 1] - times_ns.front());
      FrameInfo lost;
      lost.index = std::uint32_t(frames_.size());
      lost.time_s = before_s + (time_s - before_s) * double(k) / double(missing[i] + 1);
      lost.status = FrameStatus::kDropped;
      frames_.push_back(lost);
      places_.emplace_back();
    }
    FrameInfo info;
    info.index = std::uint32_t(frames_.size());
    info.time_s = time_s;
    frames_.push_back(info);
    places_.push_back({shots[i].place, kNone});
  }
  return {};
}

void BagSequence::match_colors(const std::vector<Shot>& shots, const Timeline& times) {
  if (shots.empty()) return;
  for (const Shot& shot : shots) colors_.push_back(shot.place);
  std::vector<std::uint32_t> order(shots.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto& at = times.color_ns;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return at[a] < at[b]; });
  const double near_s = std::max(kNearest_s, kNear * median_step_s(times.depth_ns));
  std::size_t shot = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (frames_[i].status == FrameStatus::kDropped) continue;
    const std::int64_t wanted = times.depth_ns[shot++];
    const auto after =
        std::lower_bound(order.begin(), order.end(), wanted,
                         [&](std::uint32_t a, std::int64_t time) { return at[a] < time; });
    double best_s = near_s;
    const auto offer = [&](std::uint32_t color) {
      const double off_s = std::abs(seconds(at[color] - wanted));
      if (off_s > best_s) return;
      best_s = off_s;
      places_[i].color = color;
    };
    if (after != order.begin()) offer(*std::prev(after));
    if (after != order.end()) offer(*after);
  }
}

/// The size of the images must match that of their cameras.
Result<> BagSequence::look_at_first() {
  CameraIntrinsics& camera = header_.sensors.front().intrinsics;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (frames_[i].status == FrameStatus::kDropped) continue;
    TURNSCAN_ASSIGN(const DepthImage depth, depth_of(places_[i].depth));
    if (camera.width == 0) {
      camera.width = depth.width;
      camera.height = depth.height;
    }
    if (depth.width != camera.width || depth.height != camera.height)
      return fail_at(bag_.path().string(), ErrorCode::kFormat,
                     "the depth images have {} x {} pixels, but their camera has {} x {}; state "
                     "it: --intrinsics fx,fy,cx,cy",
                     depth.width, depth.height, camera.width, camera.height);
    break;
  }
  return camera.check();
}

Result<DepthImage> BagSequence::depth_of(const MessagePlace& place) const {
  TURNSCAN_ASSIGN(const auto message, bag_.read(place));
  const double unit_m = header_.sensors.front().depth_unit_m;
  if (streams_.depth_compressed) {
    TURNSCAN_ASSIGN(const auto image, rosbag::parse_compressed_image(message.bytes, message.wire));
    return ros_depth(image, unit_m);
  }
  TURNSCAN_ASSIGN(const auto image, rosbag::parse_image(message.bytes, message.wire));
  return ros_depth(image, unit_m);
}

Result<> BagSequence::read_color(const MessagePlace& place, Frame& frame) const {
  TURNSCAN_ASSIGN(const auto message, bag_.read(place));
  if (streams_.color_compressed) {
    TURNSCAN_ASSIGN(const auto image, rosbag::parse_compressed_image(message.bytes, message.wire));
    return take_ros_color(image, frame);
  }
  TURNSCAN_ASSIGN(const auto image, rosbag::parse_image(message.bytes, message.wire));
  TURNSCAN_ASSIGN(frame.color, ros_color(image));
  return {};
}

template <class Image>
Result<> check_size(const Image& image, const CameraIntrinsics& camera, std::string_view topic) {
  if (image.width == camera.width && image.height == camera.height) return {};
  return fail(ErrorCode::kFormat, "an image of {} has {} x {} pixels, but its camera has {} x {}",
              topic, image.width, image.height, camera.width, camera.height);
}

Result<Frame> BagSequence::read(std::size_t position) const {
  if (position >= frames_.size())
    throw std::invalid_argument(fmt::format("import: there is no frame {}", position));
  Frame frame;
  frame.info = frames_[position];
  if (frame.info.status == FrameStatus::kDropped)
    return fail(ErrorCode::kMissingData, "frame {} was dropped", frame.info.index);
  const auto here = [&](const Error& error) {
    Error out = error;
    out.message = fmt::format("frame {}: {}", frame.info.index, error.message);
    return at_path(bag_.path(), std::move(out));
  };
  const Places& places = places_[position];
  const SensorInfo& sensor = header_.sensors.front();
  auto depth = depth_of(places.depth);
  if (!depth) return here(depth.error());
  frame.depth = std::move(*depth);
  if (auto good = check_size(frame.depth, sensor.intrinsics, streams_.depth_topic); !good)
    return here(good.error());
  if (places.color == kNone) return frame;
  if (auto color = read_color(colors_[places.color], frame); !color) return here(color.error());
  if (auto good = check_size(frame.color, sensor.color_intrinsics.value_or(sensor.intrinsics),
                             streams_.color_topic);
      !good)
    return here(good.error());
  return frame;
}

}  // namespace

Result<std::unique_ptr<FrameSequence>> make_bag_sequence(Bag bag, BagStreams streams,
                                                         SequenceHeader header) {
  header.software = fmt::format("turnscan {}", version());
  auto out = std::make_unique<BagSequence>(std::move(bag), std::move(streams), std::move(header));
  TURNSCAN_TRY(out->list());
  return out;
}

}  // namespace turnscan::importers
