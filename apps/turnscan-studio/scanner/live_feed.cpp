#include "scanner/live_feed.hpp"

#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/sequence_views.hpp>

#include "scanner/live_session.hpp"

namespace turnscan::studio {

namespace {

/// From an earlier recording, unless the device itself knows the pose of its table.
std::shared_ptr<const Calibration> kept_of(const SourceInfo& info) {
  if (info.header.turntable || info.identities.empty()) return nullptr;
  auto kept = kept_calibration(info.identities.front());
  if (!kept || !*kept) return nullptr;
  return std::make_shared<const Calibration>(std::move(**kept));
}

}  // namespace

void LiveFeed::start(const std::string& uri) {
  stop();
  {
    const std::lock_guard lock(mutex_);
    state_ = {};
    collected_.clear();
    wanted_ = 0;
    request_.reset();
    turn_.reset();
  }
  context_ = std::make_unique<RunContext>();
  ended_ = false;
  thread_ = std::thread([this, uri, context = *context_] {
    try {
      run(uri, context);
    } catch (const std::exception& failure) {
      fail_with({ErrorCode::kLibrary, failure.what(), {}});
    }
    ended_ = true;
  });
}

void LiveFeed::stop() {
  if (!thread_.joinable()) return;
  cancel();
  thread_.join();
}

void LiveFeed::cancel() {
  if (context_) context_->cancel();
  stop_recording();
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
    state_.kept = kept_of((*source)->info());
  }
  Session session(*this, **source);
  std::optional<Error> failure;
  for (;;) {
    std::optional<RecordingRequest> request;
    RunContext recording;
    {
      const std::lock_guard lock(mutex_);
      request.swap(request_);
      recording = recording_context_;
    }
    if (auto laid = lay_now(**source); !laid) {
      failure = laid.error();
      break;
    }
    if (request) session.record(*request, recording);
    auto delivery = (*source)->next(0.1, context);
    if (!delivery) failure = delivery.error();
    if (!delivery || delivery->kind == Delivery::Kind::kEnd) break;
    if (delivery->kind == Delivery::Kind::kFrame) session.take(delivery->frame);
    if (delivery->kind == Delivery::Kind::kNothing) session.note_silence();
  }
  (*source)->stop();
  if (failure) return fail_with(*failure);
  const std::lock_guard lock(mutex_);
  state_.open = false;
}

Result<> LiveFeed::lay_now(FrameSource& source) {
  std::optional<ObjectTurn> turn;
  {
    const std::lock_guard lock(mutex_);
    turn.swap(turn_);
  }
  if (!turn || !source.info().lays_object) return {};
  source.stop();
  if (auto laid = source.lay_object(turn->rotation, turn->time_s); !laid) {
    const std::lock_guard lock(mutex_);
    state_.record_error = laid.error().text();
  }
  return source.start();
}

void LiveFeed::lay_object(const ObjectTurn& turn) {
  const std::lock_guard lock(mutex_);
  turn_ = turn;
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
  return std::make_unique<MemoryFrames>(header_, std::move(collected_));
}

void LiveFeed::record(const RecordingRequest& request) {
  const std::lock_guard lock(mutex_);
  recording_context_ = RunContext();
  state_.recording = true;
  request_ = request;
}

void LiveFeed::stop_recording() {
  const std::lock_guard lock(mutex_);
  recording_context_.cancel();
}

LiveState LiveFeed::take_state() {
  const std::lock_guard lock(mutex_);
  LiveState out = state_;
  state_.picture = nullptr;
  state_.kept = nullptr;
  if (state_.seen) state_.seen->picture = nullptr;
  state_.surface = nullptr;
  state_.finished.clear();
  state_.outcome.clear();
  state_.record_error.clear();
  return out;
}

}  // namespace turnscan::studio
