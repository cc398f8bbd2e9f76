#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <turnscan/capture/recorder/recorder.hpp>
#include <turnscan/core/guarded.hpp>
#include <turnscan/io/image/image_io.hpp>

namespace turnscan {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr auto kLookAtDisk = std::chrono::milliseconds(100);

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

tl::unexpected<Error> too_little_space(const fs::path& folder, double free, double wanted) {
  return fail_at(folder.string(), ErrorCode::kIo,
                 "only {:.0f} MB are free on the disk, and {:.0f} MB are wanted; make room, or "
                 "record to another disk",
                 free * 1e-6, wanted * 1e-6);
}

struct Job {
  std::uint64_t number = 0;  ///< position in the order of put()
  Frame frame;
  bool by_disk = false;  ///< dropped because the queue was full
  Clock::time_point since;
};

/// A frame whose files have been written.
struct Written {
  FrameInfo info;
  std::string line;
  bool by_disk = false;
  Clock::time_point since;
};

}  // namespace

Result<std::uint64_t> free_space(const fs::path& folder) {
  std::error_code error;
  fs::path place = fs::absolute(folder, error);
  while (!place.empty() && !fs::exists(place, error) && place != place.parent_path())
    place = place.parent_path();
  struct statvfs status {};
  if (::statvfs(place.c_str(), &status) != 0)
    return fail_at(folder.string(), ErrorCode::kIo, "cannot find out the free space: {}",
                   std::generic_category().message(errno));
  return std::uint64_t(status.f_bavail) * std::uint64_t(status.f_frsize);
}

OptionTable describe(RecorderOptions& o) {
  OptionTable table;
  table
      .number("record-queue", o.queue_frames, {1, 10000},
              "Number of frames that may wait to be written; further frames are dropped")
      .number("record-threads", o.encoders, {1, 64},
              "Number of threads that encode and write frames")
      .number("min-free", o.min_free_bytes, Quantity::kNone, {0.0, 1e15},
              "Stop before the disk has fewer free bytes than this")
      .choice(
          "color-files", o.color, {"png", "jpeg"},
          "Format of colour images; PNG is lossless. JPEG images of the source stay as they are")
      .number("color-quality", o.color_quality, {1, 100},
              "Quality of colour images that are written as JPEG");
  return table;
}

struct Recorder::State {
  State(RecordingWriter w, fs::path path, RecorderOptions o)
      : writer(std::move(w)), folder(std::move(path)), options(o) {}

  RecordingWriter writer;
  fs::path folder;
  RecorderOptions options;
  std::vector<std::thread> threads;

  std::mutex mutex;  // guards the following members
  std::condition_variable wake, room;
  std::deque<Job> queue;
  int waiting_frames = 0;  ///< in the queue, excluding dropped ones, which cost nothing
  std::uint64_t puts = 0;
  std::optional<std::uint32_t> last_index;
  bool closing = false;  ///< no further frames will be added
  bool aborting = false;
  std::optional<Error> failed;
  RecorderStatistics counts;

  // Guards the following members, and the writer's lines; locked before `mutex`.
  std::mutex append_mutex;
  std::map<std::uint64_t, Written> ready;
  std::uint64_t next_number = 0;
  Clock::time_point looked_at_disk;
  std::uint64_t bytes_until_look = 0;  ///< half of the room at the last one

  void run();
  bool work();
  Result<std::string> write_files(Frame& frame) const;
  void fail_with(Error error);
  Result<> append_ready();
  Result<> look_at_disk(Clock::time_point now, std::uint64_t written_bytes);
  std::uint64_t bytes_of(const FrameInfo& info) const;
};

void Recorder::State::fail_with(Error error) {
  const std::lock_guard lock(mutex);
  if (!failed) failed = std::move(error);
  room.notify_one();
}

std::uint64_t Recorder::State::bytes_of(const FrameInfo& info) const {
  std::error_code error;
  std::uint64_t sum = 0;
  const std::string number = fmt::format("{:06}", info.index);
  for (const std::string& name : {"depth/" + number + ".png", "points/" + number + ".ply",
                                  "color/" + number + ".png", "color/" + number + ".jpg"}) {
    const auto size = fs::file_size(folder / name, error);
    if (!error) sum += size;
  }
  return sum;
}

Result<> Recorder::State::look_at_disk(Clock::time_point now, std::uint64_t written_bytes) {
  bytes_until_look -= std::min(bytes_until_look, written_bytes);
  if (bytes_until_look > 0 && now - looked_at_disk < kLookAtDisk) return {};
  looked_at_disk = now;
  TURNSCAN_ASSIGN(const std::uint64_t free, free_space(folder));
  bytes_until_look = std::uint64_t(std::max(0.0, double(free) - options.min_free_bytes) / 2);
  {
    const std::lock_guard lock(mutex);
    counts.free_bytes = free;
  }
  if (double(free) >= options.min_free_bytes) return {};
  return too_little_space(folder, double(free), options.min_free_bytes);
}

/// Called with append_mutex locked.
Result<> Recorder::State::append_ready() {
  for (auto first = ready.begin(); first != ready.end() && first->first == next_number;
       first = ready.begin()) {
    const Written& frame = first->second;
    TURNSCAN_TRY(writer.append_line(frame.info, frame.line));
    const auto now = Clock::now();
    const bool dropped = frame.info.status == FrameStatus::kDropped;
    const std::uint64_t bytes = dropped ? 0 : bytes_of(frame.info);
    {
      const std::lock_guard lock(mutex);
      counts.bytes += bytes;
      counts.written += dropped ? 0 : 1;
      counts.dropped_by_source += dropped && !frame.by_disk ? 1 : 0;
      counts.most_wait_s = std::max(counts.most_wait_s, seconds(now - frame.since));
    }
    ready.erase(first);
    ++next_number;
    TURNSCAN_TRY(look_at_disk(now, bytes));
  }
  return {};
}

Result<std::string> Recorder::State::write_files(Frame& frame) const {
  const ColorImage& color = frame.color;
  const bool whole =
      !color.empty() && color.pixels.size() == std::size_t(color.width) * std::size_t(color.height);
  if (options.color == ColorFileFormat::kJpeg && frame.color_jpeg.empty() && whole) {
    TURNSCAN_ASSIGN(frame.color_jpeg, encode_color_jpeg(color, options.color_quality));
  }
  return writer.write_files(frame);
}

/// Processes one frame. False: there are no more.
bool Recorder::State::work() {
  std::unique_lock lock(mutex);
  wake.wait(lock, [this] { return closing || !queue.empty(); });
  if (queue.empty() || aborting) return false;
  Job job = std::move(queue.front());
  queue.pop_front();
  if (job.frame.info.status != FrameStatus::kDropped) --waiting_frames;
  room.notify_one();
  // After a failure no further lines are written: their order is guaranteed.
  const bool skip = failed.has_value();
  lock.unlock();
  if (skip) return true;
  const double begin = thread_cpu_s();
  auto line = write_files(job.frame);
  const double used = thread_cpu_s() - begin;
  if (!line) {
    fail_with(std::move(line).error());
    return true;
  }
  {
    const std::lock_guard append(append_mutex);
    ready[job.number] = {job.frame.info, std::move(*line), job.by_disk, job.since};
    if (auto done = append_ready(); !done) fail_with(std::move(done).error());
  }
  lock.lock();
  counts.encode_cpu_s += used;
  return true;
}

void Recorder::State::run() {
  for (bool more = true; more;) {
    const auto worked = guarded([&]() -> Result<> {
      more = work();
      return {};
    });
    if (!worked) fail_with(worked.error());
  }
}

Recorder::Recorder(std::unique_ptr<State> state) : state_(std::move(state)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Recorder::~Recorder() {
  if (!state_) return;
  {
    const std::lock_guard lock(state_->mutex);
    state_->closing = state_->aborting = true;
  }
  state_->wake.notify_all();
  for (std::thread& thread : state_->threads)
    if (thread.joinable()) thread.join();
}

namespace {

Result<> check_room(const fs::path& folder, const RecorderOptions& options, double expected_bytes) {
  RecorderOptions copy = options;
  TURNSCAN_TRY(turnscan::describe(copy).check());
  TURNSCAN_ASSIGN(const std::uint64_t free, free_space(folder));
  if (double(free) < options.min_free_bytes + expected_bytes)
    return too_little_space(folder, double(free), options.min_free_bytes + expected_bytes);
  return {};
}

}  // namespace

Result<Recorder> Recorder::create(const fs::path& folder, const SequenceHeader& header,
                                  const CaptureSettings& settings, const RecorderOptions& options,
                                  double expected_bytes) {
  TURNSCAN_TRY(check_room(folder, options, expected_bytes));
  return of(RecordingWriter::create(folder, header, settings, options.color), folder, options);
}

Result<Recorder> Recorder::extend(const fs::path& folder, const RecorderOptions& options,
                                  double expected_bytes, std::optional<std::uint32_t> resumed_at,
                                  bool was_finished) {
  TURNSCAN_TRY(check_room(folder, options, expected_bytes));
  return of(RecordingWriter::extend(folder, options.color, resumed_at, was_finished), folder,
            options);
}

Result<Recorder> Recorder::of(Result<RecordingWriter> writer, const fs::path& folder,
                              const RecorderOptions& options) {
  if (!writer) return tl::unexpected<Error>(std::move(writer).error());
  auto state = std::make_unique<State>(std::move(*writer), folder, options);
  if (const auto free = free_space(folder)) state->counts.free_bytes = *free;
  // Joins the threads already started if one cannot be started.
  Recorder recorder(std::move(state));
  for (int i = 0; i < options.encoders; ++i)
    recorder.state_->threads.emplace_back([raw = recorder.state_.get()] { raw->run(); });
  return recorder;
}

Result<> Recorder::put(Frame frame) {
  State& s = *state_;
  const std::lock_guard lock(s.mutex);
  if (s.closing) throw std::invalid_argument("recorder: put() after finish()");
  if (s.failed) return tl::unexpected<Error>(*s.failed);
  if (s.last_index && frame.info.index <= *s.last_index)
    return fail(ErrorCode::kInvalidOption, "recorder: the frame {} comes after the frame {}",
                frame.info.index, *s.last_index);
  s.last_index = frame.info.index;
  bool by_disk = false;
  if (frame.info.status != FrameStatus::kDropped && s.waiting_frames >= s.options.queue_frames) {
    FrameInfo info = frame.info;
    frame = Frame();
    frame.info = std::move(info);
    frame.info.status = FrameStatus::kDropped;
    by_disk = true;
    ++s.counts.dropped_by_disk;
  }
  if (frame.info.status != FrameStatus::kDropped) ++s.waiting_frames;
  s.queue.push_back({s.puts++, std::move(frame), by_disk, Clock::now()});
  s.counts.most_waiting = std::max(s.counts.most_waiting, std::size_t(s.waiting_frames));
  s.wake.notify_one();
  return {};
}

void Recorder::wait_for_room() {
  std::unique_lock lock(state_->mutex);
  state_->room.wait(lock, [this] {
    return state_->failed || state_->waiting_frames < state_->options.queue_frames;
  });
}

void Recorder::describe(const SequenceHeader& header, const CaptureSettings& settings) {
  const std::lock_guard append(state_->append_mutex);
  state_->writer.describe(header, settings);
}

Result<> Recorder::finish() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->closing = true;
  }
  state_->wake.notify_all();
  for (std::thread& thread : state_->threads)
    if (thread.joinable()) thread.join();
  return state_->writer.finish(Durability::kSynced);
}

RecorderStatistics Recorder::statistics() const {
  const std::lock_guard lock(state_->mutex);
  RecorderStatistics out = state_->counts;
  out.waiting = std::size_t(state_->waiting_frames);
  return out;
}

}  // namespace turnscan
