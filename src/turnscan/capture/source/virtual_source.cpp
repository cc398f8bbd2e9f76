// The simulator as a sensor: it reveals no more about the table than a real one, unless asked to.

#include <cmath>
#include <deque>
#include <turnscan/capture/source/pacer.hpp>
#include <turnscan/capture/source/virtual_fault.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/scene_file.hpp>

namespace turnscan::source {

namespace {

constexpr int kEndlessFrames = 100000;    // 55 minutes at 30 frames a second
constexpr double kFramesPerTurn = 920.0;  // at the default speed, as in the simulator
constexpr double kLatency_s = 0.004, kLatencyJitter_s = 0.003;

struct VirtualOptions {
  std::string sensor = "kinect-v2";
  std::string unit;
  std::string serial = "0";
  std::string fault;
  bool realtime = false;
  double appears_s = 0.0;
  double clock_s = 0.0;
  int prepared = 0;
};

OptionTable describe(VirtualOptions& o) {
  OptionTable table;
  table.text("sensor", o.sensor, "A preset or a file of the simulator")
      .text("unit", o.unit, "Unit of the object's file if that does not say it")
      .text("serial", o.serial, "Serial number")
      .text("fault", o.fault, "Simulated faults and their times: stall@2s+5s,lost@10s")
      .flag("realtime", o.realtime, "Deliver frames in real time; those that nobody takes are lost")
      .number("appears", o.appears_s, Quantity::kTime, {0.0, 1e6},
              "Time at which the object is put on the table, which is empty before")
      .number("clock", o.clock_s, Quantity::kTime, {-1e6, 1e6},
              "Offset by which the sensor's clock is ahead")
      .number("prepared", o.prepared, {0, 100000},
              "Number of frames to render at the start and to repeat from then on");
  return table;
}

struct Description {
  VirtualOptions options;
  SceneDescription scene;
};

bool given(const SourceUri& uri, std::string_view name) {
  for (const auto& parameter : uri.parameters)
    if (parameter.first == name) return true;
  return false;
}

/// Like a real sensor: the table is not known. Endless unless a duration is given.
Result<Description> describe_uri(const SourceUri& uri) {
  Description d;
  d.scene.record.calibration = RecordedCalibration::kNone;
  d.scene.record.angles = false;
  OptionTable table = describe(d.options);
  for (SceneTable& part : describe(d.scene)) table.append(std::move(part.options));
  TURNSCAN_TRY(set_from_uri(uri, table));
  TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(d.options.sensor));
  d.scene.scanners = {std::move(entry)};
  MotionOptions& motion = d.scene.motion;
  if (!given(uri, "frames") && !given(uri, "turns")) {
    motion.frames = kEndlessFrames;
    if (!motion.speed_rad_s) motion.speed_rad_s = kTurn * motion.fps / kFramesPerTurn;
  }
  return d;
}

Result<std::vector<TriangleMesh>> load_objects(const SourceUri& uri, const Description& d,
                                               const RunContext& context) {
  std::string name = uri.address;
  if (name.starts_with("builtin:")) name.erase(0, std::string_view("builtin:").size());
  if (name == "empty") return std::vector<TriangleMesh>();
  if (name.empty())
    return fail(ErrorCode::kInvalidOption,
                "virtual: there is no object; write virtual:OBJECT, with one of {}, empty or a "
                "mesh file",
                fmt::join(builtin_object_names(), ", "));
  TriangleMesh mesh;
  if (name.find_first_of("./") == std::string::npos) {
    TURNSCAN_ASSIGN(mesh, builtin_object(name, context));
  } else {
    ReadMeshOptions options;
    if (!d.options.unit.empty()) {
      TURNSCAN_ASSIGN(options.metres_per_unit, metres_per(d.options.unit));
    }
    TURNSCAN_ASSIGN(mesh, read_mesh(name, options, context));
  }
  TURNSCAN_ASSIGN(PlacedObject placed, place_object(std::move(mesh), d.scene.object_placement));
  std::vector<TriangleMesh> objects;
  objects.push_back(std::move(placed.mesh));
  return objects;
}

/// Half the height of the objects, at which scanners aim: the same with and without the objects.
double middle_of(const std::vector<TriangleMesh>& objects) {
  float top = 0.0f;
  for (const TriangleMesh& mesh : objects)
    for (const Vec3f& p : mesh.vertices) top = std::max(top, p.y());
  return 0.5 * double(top);
}

tl::unexpected<Error> refusal(VirtualFault::Kind kind) {
  switch (kind) {
    case VirtualFault::Kind::kMissing:
      return fail(ErrorCode::kNotFound, "virtual: no device is connected; plug it in");
    case VirtualFault::Kind::kBusy:
      return fail(ErrorCode::kDeviceBusy,
                  "virtual: another program uses the device; close that program");
    default:
      return fail(ErrorCode::kNoPermission,
                  "virtual: this user may not open the device; install the udev rule of "
                  "docs/reference/devices.md and plug the device in again");
  }
}

constexpr double kPause_s = 1.0;  ///< between two passes, in sensor time

/// One pose of the object.
struct Laid {
  VirtualScan scan;
  double start_s = 0.0;  ///< of the scan, in the source's time
};

class VirtualGrabber : public Grabber {
 public:
  VirtualGrabber(const SourceUri& uri, const Description& d, VirtualScanOptions scan_options,
                 VirtualScan scan, std::optional<VirtualScan> empty,
                 std::vector<VirtualFault> faults)
      : options_(d.options),
        scan_options_(std::move(scan_options)),
        empty_(std::move(empty)),
        faults_(std::move(faults)),
        pacer_(d.options.realtime ? 1.0 : 0.0) {
    laid_.push_back({std::move(scan), 0.0});
    info_.uri = format_source_uri(uri);
    info_.driver = uri.scheme;
    info_.header = this->scan().header();
    info_.lays_object = !this->scan().objects().empty();
    if (info_.header.turntable) info_.T_table_common = this->scan().T_table_given();
    info_.fps = d.scene.motion.fps;
    info_.live = pacer_.live();
    if (given(uri, "frames") || given(uri, "turns"))
      info_.frame_count = this->scan().frames().size();
    const std::string model = d.scene.scanners.front().model;
    info_.identities.push_back(identity_text(
        fmt::format("virtual-{}-{}", model.substr(model.rfind('/') + 1), d.options.serial)));
    info_.settings["noise"] = d.scene.measure.noise;
    info_.settings["seed"] = fmt::format("{}", d.scene.measure.seed);
  }

  const SourceInfo& info() const override { return info_; }

  Result<> start() override {
    TURNSCAN_TRY(prepare());
    if (next_ < scan().frames().size()) pacer_.restart(time_of(next_));
    return {};
  }
  void stop() override {}

  Result<> lay_object(const Eigen::Matrix3d& rotation, double time_s) override {
    time_s -= options_.clock_s;
    const auto after = std::find_if(laid_.begin(), laid_.end(),
                                    [&](const Laid& l) { return l.start_s > time_s + 1e-6; });
    if (after == laid_.begin())
      return fail(ErrorCode::kNotFound, "virtual: there was no frame at {:.3f} s", time_s);
    const Laid& then = *std::prev(after);
    const auto& frames = then.scan.frames();
    const auto frame = std::find_if(frames.begin(), frames.end(), [&](const FrameInfo& f) {
      return std::abs(then.start_s + f.time_s - time_s) < 1e-6;
    });
    if (frame == frames.end())
      return fail(ErrorCode::kNotFound, "virtual: there was no frame at {:.3f} s", time_s);
    auto objects = turned(then.scan, std::size_t(frame - frames.begin()), rotation);
    scan_options_.first_instant += std::uint32_t(scan().frames().size());
    TURNSCAN_ASSIGN(VirtualScan next, VirtualScan::create(std::move(objects), scan_options_));
    const double last_s = time_of(std::min(next_, scan().frames().size() - 1));
    laid_.push_back({std::move(next), last_s + kPause_s});
    next_ = 0;
    ahead_.clear();
    prepared_.clear();
    return {};
  }

  Result<Delivery> grab(double timeout_s) override {
    Delivery out;
    if (next_ == scan().frames().size()) {
      out.kind = Delivery::Kind::kEnd;
      return out;
    }
    const double time_s = time_of(next_);
    if (fault_at(VirtualFault::Kind::kLost, time_s) != nullptr)
      return fail(ErrorCode::kDeviceLost,
                  "virtual: the device stopped answering; check the cable and the power supply");
    if (const VirtualFault* stall = fault_at(VirtualFault::Kind::kStall, time_s))
      return stalled(*stall, timeout_s);
    if (!pacer_.live() || pacer_.lateness(time_s) < 0.5 / info_.fps) TURNSCAN_TRY(look_ahead());
    if (!pacer_.wait(time_s, timeout_s)) return out;
    out.kind = Delivery::Kind::kFrame;
    out.frame = take(time_s);
    const double latency_s = kLatency_s + kLatencyJitter_s * uniform01(hash_key(0x1a7e9c, next_));
    out.host_time_s = pacer_.live() ? steady_seconds() : time_s + latency_s;
    ++next_;
    return out;
  }

 private:
  const VirtualScan& scan() const { return laid_.back().scan; }
  /// Time of a frame in the source's time, without its clock error.
  double time_of(std::size_t position) const {
    return laid_.back().start_s + scan().frames()[position].time_s;
  }

  /// See FrameSource::lay_object(); in the frame in which a scan takes its objects.
  static std::vector<TriangleMesh> turned(const VirtualScan& scan, std::size_t position,
                                          const Eigen::Matrix3d& rotation) {
    const Eigen::Matrix3d turn_table_sensor = rotation_about_y(scan.angle_rad(position)).linear() *
                                              scan.T_table_sensor(position).linear();
    const Eigen::Matrix3d turn_given_table = scan.T_table_given().linear().transpose();
    const Eigen::Matrix3d turn = turn_given_table * turn_table_sensor * rotation *
                                 turn_table_sensor.transpose() *
                                 rotation_about_y(scan.angle_rad(position)).linear();
    std::vector<TriangleMesh> objects(scan.objects().begin(), scan.objects().end());
    Box box;
    for (TriangleMesh& mesh : objects) {
      for (Vec3f& p : mesh.vertices) {
        p = (turn * p.cast<double>()).cast<float>();
        box.add(p.cast<double>());
      }
      for (Vec3f& n : mesh.normals) n = (turn * n.cast<double>()).cast<float>();
    }
    const Vec3f shift = -Vec3d(box.center().x(), box.min.y(), box.center().z()).cast<float>();
    for (TriangleMesh& mesh : objects)
      for (Vec3f& p : mesh.vertices) p += shift;
    return objects;
  }

  const VirtualFault* fault_at(VirtualFault::Kind kind, double time_s) const {
    const double frame_s = 0.999 / info_.fps;
    for (const VirtualFault& fault : faults_) {
      const bool over = kind != VirtualFault::Kind::kLost &&
                        time_s >= fault.begin_s + std::max(fault.length_s, frame_s);
      if (fault.kind == kind && time_s >= fault.begin_s && !over) return &fault;
    }
    return nullptr;
  }

  /// Delivers nothing; the frames of that interval are lost.
  Delivery stalled(const VirtualFault& fault, double timeout_s) {
    if (pacer_.live()) {
      if (!pacer_.wait(fault.begin_s + fault.length_s, timeout_s)) return {};
    }
    while (next_ < scan().frames().size() && fault_at(VirtualFault::Kind::kStall, time_of(next_)))
      ++next_;
    ahead_.clear();
    return {};
  }

  const VirtualScan& scan_at(double time_s) const {
    return empty_ && time_s < options_.appears_s ? *empty_ : scan();
  }

  Result<Frame> render(std::size_t position) const {
    const FrameInfo& listed = scan().frames()[position];
    Frame frame;
    frame.info = listed;
    if (listed.status == FrameStatus::kDropped) return frame;
    return scan_at(time_of(position)).read(position);
  }

  /// Renders frames from `first` on, on all cores.
  Result<std::deque<Frame>> render_all(std::size_t first, std::size_t count) const {
    std::vector<Result<Frame>> rendered(count);
    parallel_for(count, 1, [&](std::size_t i) { rendered[i] = render(first + i); });
    std::deque<Frame> frames;
    for (auto& frame : rendered) {
      if (!frame) return tl::unexpected<Error>(std::move(frame).error());
      frames.push_back(std::move(*frame));
    }
    return frames;
  }

  Result<> prepare() {
    if (options_.prepared == 0 || !prepared_.empty()) return {};
    TURNSCAN_ASSIGN(
        prepared_, render_all(0, std::min(std::size_t(options_.prepared), scan().frames().size())));
    return {};
  }

  Result<> look_ahead() {
    if (!prepared_.empty() || !ahead_.empty()) return {};
    const std::size_t threads = std::max(1, thread_count());
    TURNSCAN_ASSIGN(ahead_, render_all(next_, std::min(threads, scan().frames().size() - next_)));
    return {};
  }

  /// The frame next_, as sent by the sensor; dropped if the simulator could not keep up.
  Frame take(double time_s) {
    Frame frame;
    if (!prepared_.empty()) {
      frame = prepared_[next_ % prepared_.size()];
      frame.info = scan().frames()[next_];
    } else if (!ahead_.empty()) {
      frame = std::move(ahead_.front());
      ahead_.pop_front();
    } else {
      frame.info = scan().frames()[next_];
      frame.info.status = FrameStatus::kDropped;
    }
    frame.info.time_s = time_s + options_.clock_s;
    if (fault_at(VirtualFault::Kind::kGap, time_s) != nullptr) {
      Frame lost;
      lost.info = frame.info;
      lost.info.status = FrameStatus::kDropped;
      return lost;
    }
    if (fault_at(VirtualFault::Kind::kSize, time_s) != nullptr) frame.depth = DepthImage(1, 1);
    if (fault_at(VirtualFault::Kind::kBackwards, time_s) != nullptr) frame.info.time_s -= 1.0;
    return frame;
  }

  VirtualOptions options_;
  VirtualScanOptions scan_options_;
  std::vector<Laid> laid_;            ///< the last one is current; never empty
  std::optional<VirtualScan> empty_;  ///< the table before the object is placed
  std::vector<VirtualFault> faults_;
  SourceInfo info_;
  Pacer pacer_;
  std::size_t next_ = 0;
  std::deque<Frame> ahead_;  ///< rendered frames from next_ on
  std::deque<Frame> prepared_;
};

}  // namespace

Result<std::unique_ptr<Grabber>> open_virtual(const SourceUri& uri, const RunContext& context) {
  TURNSCAN_ASSIGN(Description d, describe_uri(uri));
  TURNSCAN_ASSIGN(auto faults, parse_virtual_faults(d.options.fault));
  for (const VirtualFault& fault : faults)
    if (fault.kind == VirtualFault::Kind::kMissing || fault.kind == VirtualFault::Kind::kBusy ||
        fault.kind == VirtualFault::Kind::kDenied)
      return refusal(fault.kind);
  TURNSCAN_ASSIGN(auto objects, load_objects(uri, d, context));
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(VirtualScanOptions options, scan_options(d.scene));
  for (VirtualScanner& scanner : options.scanners)
    if (!scanner.placement.aim_height_m) scanner.placement.aim_height_m = middle_of(objects);
  std::optional<VirtualScan> empty;
  if (d.options.appears_s > 0.0) {
    TURNSCAN_ASSIGN(VirtualScan without, VirtualScan::create({}, options));
    empty = std::move(without);
  }
  TURNSCAN_ASSIGN(VirtualScan scan, VirtualScan::create(std::move(objects), options));
  return std::unique_ptr<Grabber>(std::make_unique<VirtualGrabber>(
      uri, d, std::move(options), std::move(scan), std::move(empty), std::move(faults)));
}

}  // namespace turnscan::source
