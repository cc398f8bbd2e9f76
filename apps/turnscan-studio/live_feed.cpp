#include "live_feed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <turnscan/capture/frame_source.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/crop.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan::studio {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPictureEvery_s = 0.06;
constexpr std::size_t kShownPoints = 150000;
constexpr double kCropMargin_m = 0.004;

/// Frames in memory.
class Collected : public FrameSequence {
 public:
  Collected(SequenceHeader header, std::vector<Frame> frames)
      : header_(std::move(header)), data_(std::move(frames)) {
    for (const Frame& frame : data_) frames_.push_back(frame.info);
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override { return data_.at(position); }

 private:
  SequenceHeader header_;
  std::vector<Frame> data_;
  std::vector<FrameInfo> frames_;
};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

/// What the thread holds while a source is open.
struct LiveFeed::Session {
  LiveFeed& feed;
  FrameSource& source;
  std::vector<RayTable> rays;
  Clock::time_point last_picture = Clock::now(), last_rate = Clock::now();
  std::uint64_t frames_at_rate = 0;
  double fps = 0.0;

  std::optional<RecordingWriter> writer;
  RecordingWish wish;
  std::uint64_t recorded = 0;
  std::optional<double> first_time_s, first_angle_rad;

  Session(LiveFeed& f, FrameSource& s) : feed(f), source(s) {
    for (const SensorInfo& sensor : source.info().header.sensors)
      rays.emplace_back(sensor.intrinsics);
  }

  std::shared_ptr<const Calibration> calibration() {
    const std::lock_guard lock(feed.mutex_);
    return feed.calibration_;
  }

  Result<> begin_recording(const RecordingWish& wanted) {
    SequenceHeader header = source.info().header;
    if (const auto known = calibration()) {
      header.turntable = known->table;
      if (wanted.speed_rad_s) header.turntable->speed_rad_s = wanted.speed_rad_s;
      TURNSCAN_ASSIGN(header.sensors[0].T_table_sensor, table_from_sensor(known->table));
      if (known->depth) header.sensors[0].depth_bias_m = known->depth->bias_m;
    }
    TURNSCAN_ASSIGN(writer, RecordingWriter::create(wanted.folder, header, source.info().settings));
    wish = wanted;
    recorded = 0;
    first_time_s.reset();
    first_angle_rad.reset();
    feed.stop_recording_ = false;
    return {};
  }

  std::optional<double> turns_at(const FrameInfo& info) {
    if (info.angle_rad) {
      if (!first_angle_rad) first_angle_rad = info.angle_rad;
      return std::abs(*info.angle_rad - *first_angle_rad) / (2.0 * std::numbers::pi);
    }
    if (!wish.speed_rad_s || std::isnan(info.time_s)) return std::nullopt;
    if (!first_time_s) first_time_s = info.time_s;
    return std::abs(*wish.speed_rad_s) * (info.time_s - *first_time_s) / (2.0 * std::numbers::pi);
  }

  Result<> end_recording() {
    if (!writer) return {};
    auto ended = writer->finish();
    writer.reset();
    const std::lock_guard lock(feed.mutex_);
    feed.state_.recording = false;
    if (ended) feed.state_.finished = wish.folder;
    return ended;
  }

  Result<> record(const Frame& frame) {
    const std::optional<double> turns = turns_at(frame.info);
    TURNSCAN_TRY(writer->append(frame));
    ++recorded;
    {
      const std::lock_guard lock(feed.mutex_);
      feed.state_.recording = true;
      feed.state_.recorded = recorded;
      feed.state_.turns = turns;
    }
    const bool done = wish.turns > 0.0 && turns && *turns >= wish.turns;
    return done || feed.stop_recording_ ? end_recording() : Result<>();
  }

  void show(const Frame& frame) {
    const double waited = seconds_since(last_rate);
    const SourceStatistics statistics = source.statistics();
    if (waited > 0.5) {
      fps = double(statistics.delivered - frames_at_rate) / waited;
      frames_at_rate = statistics.delivered;
      last_rate = Clock::now();
    }
    DrawablePtr picture;
    std::size_t count = 0;
    if (seconds_since(last_picture) > kPictureEvery_s) {
      picture = draw(frame, count);
      last_picture = Clock::now();
    }
    const std::lock_guard lock(feed.mutex_);
    feed.state_.frames = statistics.delivered;
    feed.state_.dropped = statistics.dropped();
    feed.state_.fps = fps;
    if (!picture) return;
    feed.state_.picture = std::move(picture);
    feed.state_.points = count;
  }

  DrawablePtr draw(const Frame& frame, std::size_t& count) {
    const std::size_t s = frame.info.sensor;
    const auto points = points_of(frame, source.info().header.sensors.at(s), rays.at(s));
    if (!points) return nullptr;
    PointCloud shown;
    const auto known = calibration();
    std::optional<SensorCrop> crop;
    if (feed.filter_ && known && s == 0) {
      const auto pose = table_from_sensor(known->table);
      if (pose)
        crop.emplace(Cylinder{kCropMargin_m, 2.0, known->table.radius_m.value_or(1e9)}, *pose);
    }
    const auto& all = points->cloud;
    const std::size_t step = std::max<std::size_t>(1, all.size() / kShownPoints);
    for (std::size_t i = 0; i < all.size(); i += step) {
      if (crop && !crop->keeps(all.points[i])) continue;
      shown.points.push_back(all.points[i]);
      if (!all.colors.empty()) shown.colors.push_back(all.colors[i]);
    }
    count = shown.size();
    return make_drawable(shown);
  }
};

void LiveFeed::start(const std::string& uri) {
  stop();
  {
    const std::lock_guard lock(mutex_);
    state_ = {};
    collected_.clear();
    wanted_ = 0;
    wish_.reset();
  }
  context_ = std::make_unique<RunContext>();
  thread_ = std::thread([this, uri, context = *context_] {
    try {
      run(uri, context);
    } catch (const std::exception& failure) {
      fail_with({ErrorCode::kLibrary, failure.what(), {}});
    }
  });
}

void LiveFeed::stop() {
  if (!thread_.joinable()) return;
  context_->cancel();
  thread_.join();
}

void LiveFeed::fail_with(const Error& error) {
  const std::lock_guard lock(mutex_);
  state_.open = false;
  state_.recording = false;
  if (error.code != ErrorCode::kCancelled) state_.error = error.text();
}

void LiveFeed::run(const std::string& uri, const RunContext& context) {
  auto source = open_source(uri, context);
  if (!source) return fail_with(source.error());
  if (auto started = (*source)->start(); !started) return fail_with(started.error());
  {
    const std::lock_guard lock(mutex_);
    header_ = (*source)->info().header;
    state_.open = true;
    state_.device = (*source)->info().uri;
  }
  Session session(*this, **source);
  std::optional<Error> failure;
  while (!failure) {
    auto delivery = (*source)->next(0.1, context);
    if (!delivery) {
      failure = delivery.error();
      break;
    }
    if (delivery->kind == Delivery::Kind::kEnd) break;
    std::optional<RecordingWish> wish;
    {
      const std::lock_guard lock(mutex_);
      wish.swap(wish_);
    }
    Result<> good;
    if (wish) good = session.begin_recording(*wish);
    if (good && stop_recording_ && session.writer) good = session.end_recording();
    if (good && delivery->kind == Delivery::Kind::kFrame) {
      const Frame& frame = delivery->frame;
      if (session.writer) good = session.record(frame);
      if (frame.info.status == FrameStatus::kOk) {
        session.show(frame);
        const std::lock_guard lock(mutex_);
        if (collected_.size() < wanted_) collected_.push_back(frame);
        state_.averaged = collected_.size();
      }
    }
    if (!good) {
      // The recording ends; the sensor may go on.
      session.writer.reset();
      const std::lock_guard lock(mutex_);
      state_.recording = false;
      state_.error = good.error().text();
    }
  }
  (*source)->stop();
  if (auto ended = session.end_recording(); !ended && !failure) failure = ended.error();
  if (failure) return fail_with(*failure);
  const std::lock_guard lock(mutex_);
  state_.open = false;
}

void LiveFeed::set_calibration(std::shared_ptr<const Calibration> calibration) {
  const std::lock_guard lock(mutex_);
  calibration_ = std::move(calibration);
}

void LiveFeed::collect(std::size_t frames) {
  const std::lock_guard lock(mutex_);
  collected_.clear();
  wanted_ = frames;
}

std::unique_ptr<FrameSequence> LiveFeed::take_collected() {
  const std::lock_guard lock(mutex_);
  if (wanted_ == 0 || collected_.size() < wanted_) return nullptr;
  wanted_ = 0;
  return std::make_unique<Collected>(header_, std::move(collected_));
}

void LiveFeed::record(const RecordingWish& wish) {
  const std::lock_guard lock(mutex_);
  stop_recording_ = false;
  wish_ = wish;
}

LiveState LiveFeed::take_state() {
  const std::lock_guard lock(mutex_);
  LiveState out = state_;
  state_.picture = nullptr;
  state_.finished.clear();
  return out;
}

}  // namespace turnscan::studio
