// A recording, possibly imported from another program, as a source of frames.

#include <cmath>
#include <turnscan/capture/source/pacer.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers.hpp>

namespace turnscan::source {

namespace {

constexpr double kUnknownRate = 30.0;  // frames per second, for a recording without times

struct ReplayOptions {
  std::string speed = "1";
  bool loop = false;
};

OptionTable describe(ReplayOptions& o) {
  OptionTable table;
  table.text("speed", o.speed, "Speed relative to that of the recording, or max")
      .flag("loop", o.loop, "Begin again after the last frame");
  return table;
}

/// 0: as fast as possible.
Result<double> rate_of(const std::string& text) {
  if (text == "max") return 0.0;
  const auto rate = parse_number(text);
  if (!rate || !(*rate >= 1e-3 && *rate <= 1e3))
    return fail(ErrorCode::kInvalidOption,
                "replay: speed = {} is neither a number from 0.001 to 1000 nor max", text);
  return *rate;
}

/// The replayed sequence.
struct Film {
  std::unique_ptr<FrameSequence> frames;
  CaptureSettings settings;
};

class ReplayGrabber : public Grabber {
 public:
  ReplayGrabber(Film film, const SourceUri& uri, double rate, bool loop)
      : film_(std::move(film)), recording_(*film_.frames), pacer_(rate), loop_(loop) {
    info_.uri = format_source_uri(uri);
    info_.driver = uri.scheme;
    info_.header = recording_.header();
    info_.settings = film_.settings;
    info_.live = pacer_.live();
    if (!loop) info_.frame_count = recording_.frames().size();
    const std::string name =
        std::filesystem::path(uri.address).lexically_normal().filename().string();
    for (std::size_t k = 0; k < info_.header.sensors.size(); ++k)
      info_.identities.push_back(identity_text(fmt::format("replay-{}-{}", name, k)));
    find_rate();
    find_turn();
  }

  const SourceInfo& info() const override { return info_; }

  Result<> start() override {
    if (next_ < recording_.frames().size()) pacer_.restart(time_of(next_));
    return {};
  }
  void stop() override {}

  Result<Delivery> grab(double timeout_s) override {
    if (next_ == recording_.frames().size() && !rewind()) return end();
    const double time_s = time_of(next_);
    if (!pacer_.wait(time_s, timeout_s)) return Delivery{};
    Delivery out;
    out.kind = Delivery::Kind::kFrame;
    out.host_time_s = pacer_.live() ? pacer_.due(time_s) : time_s;
    const FrameInfo& listed = recording_.frames()[next_];
    if (listed.status == FrameStatus::kOk) {
      TURNSCAN_ASSIGN(out.frame, recording_.read(next_));
    }
    out.frame.info = listed;
    out.frame.info.time_s = time_s;
    if (out.frame.info.angle_rad) *out.frame.info.angle_rad += lap_rad_;
    ++next_;
    return out;
  }

 private:
  static Delivery end() {
    Delivery out;
    out.kind = Delivery::Kind::kEnd;
    return out;
  }

  bool rewind() {
    if (!loop_ || recording_.frames().empty()) return false;
    lap_s_ += duration_s_;
    lap_rad_ += turned_rad_;
    next_ = 0;
    return true;
  }

  double time_of(std::size_t position) const {
    const double time_s = recording_.frames()[position].time_s;
    return lap_s_ + (std::isfinite(time_s) && timed_ ? time_s : double(position) / info_.fps);
  }

  /// Determines the frame rate of one sensor from the times of its frames.
  void find_rate() {
    std::size_t count = 0;
    double first_s = 0.0, last_s = 0.0;
    timed_ = true;
    for (const FrameInfo& frame : recording_.frames()) {
      timed_ = timed_ && std::isfinite(frame.time_s);
      if (frame.sensor != 0) continue;
      if (count++ == 0) first_s = frame.time_s;
      last_s = frame.time_s;
    }
    timed_ = timed_ && last_s > first_s;
    info_.fps = timed_ ? double(count - 1) / (last_s - first_s) : kUnknownRate;
    duration_s_ = timed_ ? (last_s - first_s) + 1.0 / info_.fps
                         : double(recording_.frames().size()) / info_.fps;
  }

  /// Rotation of the table per replay loop, as if the first frame followed the last one.
  void find_turn() {
    std::size_t count = 0;
    double first_rad = 0.0, last_rad = 0.0;
    for (const FrameInfo& frame : recording_.frames()) {
      if (frame.sensor != 0 || !frame.angle_rad) continue;
      if (count++ == 0) first_rad = *frame.angle_rad;
      last_rad = *frame.angle_rad;
    }
    if (count > 1) turned_rad_ = (last_rad - first_rad) * double(count) / double(count - 1);
  }

  Film film_;
  const FrameSequence& recording_;
  SourceInfo info_;
  Pacer pacer_;
  bool loop_;
  bool timed_ = false;
  double duration_s_ = 0.0, lap_s_ = 0.0;
  double turned_rad_ = 0.0, lap_rad_ = 0.0;
  std::size_t next_ = 0;
};

/// Splits the parameters into the replay's own and those of an import. "speed" belongs to the
/// replay.
std::pair<SourceUri, SourceUri> split_parameters(const SourceUri& uri, const OptionTable& own,
                                                 const OptionTable& import) {
  SourceUri of_replay{uri.scheme, uri.address, {}}, of_import = of_replay;
  for (const auto& parameter : uri.parameters) {
    const bool imports =
        own.find(parameter.first) == nullptr && import.find(parameter.first) != nullptr;
    (imports ? of_import : of_replay).parameters.push_back(parameter);
  }
  return {of_replay, of_import};
}

Result<Film> open_film(const SourceUri& uri, const ImportOptions& import,
                       const RunContext& context) {
  const std::filesystem::path path(uri.address);
  TURNSCAN_ASSIGN(const bool recording_there, file::is_there(path / "recording.json"));
  Film film;
  std::error_code error;
  const bool stated = import.format != ImportFormat::kAuto;
  if (!recording_there &&
      (stated || is_foreign(path) || std::filesystem::is_regular_file(path, error))) {
    TURNSCAN_ASSIGN(film.frames, open_foreign(path, import, context));
    return film;
  }
  if (!uri.parameters.empty())
    return fail(ErrorCode::kInvalidOption,
                "replay: {} is for files of other programs, and {} is a recording; leave it out",
                uri.parameters.front().first, uri.address);
  TURNSCAN_ASSIGN(Recording recording, Recording::open(path, context));
  film.settings = recording.capture_settings();
  film.frames = std::make_unique<Recording>(std::move(recording));
  return film;
}

}  // namespace

Result<std::unique_ptr<Grabber>> open_replay(const SourceUri& uri, const RunContext& context) {
  if (uri.address.empty())
    return fail(ErrorCode::kInvalidOption,
                "replay: there is no folder; write replay:FOLDER, e.g. replay:scans/bear");
  ReplayOptions options;
  ImportOptions import;
  const OptionTable own = describe(options), importing = describe(import);
  const auto [of_replay, of_import] = split_parameters(uri, own, importing);
  TURNSCAN_TRY(set_from_uri(of_replay, own));
  TURNSCAN_TRY(set_from_uri(of_import, importing));
  TURNSCAN_ASSIGN(const double rate, rate_of(options.speed));
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(Film film, open_film(of_import, import, context));
  return std::unique_ptr<Grabber>(
      std::make_unique<ReplayGrabber>(std::move(film), uri, rate, options.loop));
}

}  // namespace turnscan::source
