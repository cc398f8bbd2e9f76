// A recording that was resumed: nothing is known of how far the table turned in between.

#include <algorithm>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/motion_joining/relative_yaw.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kStretchSamples = 24000;  ///< of the surface that a stretch shows

class StretchMerger {
 public:
  StretchMerger(const FrameSequence& sequence, const FromMotionOptions& options,
                const DetectOptions& detect, const RunContext& context)
      : sequence_(sequence), options_(options), detect_(detect), context_(context) {
    for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
      const std::uint32_t stretch = sequence.frames()[i].stretch;
      if (i == 0 || stretch != sequence.frames()[i - 1].stretch) stretches_.emplace_back();
      stretches_.back().push_back(i);
    }
  }

  /// The longest stretch is calibrated by itself. The others are turned to where they show the same
  /// surface, or left out.
  Result<Calibration> run() {
    const auto longest =
        std::max_element(stretches_.begin(), stretches_.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    TURNSCAN_ASSIGN(SensorMotion main, calibrated(SequenceView(sequence_, *longest)));
    Calibration out = main.calibration;
    out.angles_rad.assign(sequence_.frames().size(), 0.0);
    out.angle_sigma_rad.assign(sequence_.frames().size(), std::nan(""));
    out.start_s.reset();
    for (TableSlip& slip : out.slips) slip.first_frame = (*longest)[slip.first_frame];
    put_angles(main.calibration, *longest, 0.0, out);
    for (auto stretch = stretches_.begin(); stretch != stretches_.end(); ++stretch)
      if (stretch != longest) TURNSCAN_TRY(put_stretch(*stretch, main, out));
    const double zero = out.angles_rad.front();
    for (double& angle : out.angles_rad) angle -= zero;
    return out;
  }

 private:
  using Positions = std::vector<std::size_t>;

  Result<SensorMotion> calibrated(const SequenceView& view) const {
    if (view.header().sensors.size() == 1)
      return calibrate_sensor(view, options_, detect_, kStretchSamples, context_);
    SensorMotion out;
    TURNSCAN_ASSIGN(out.calibration, calibrate_sensors(view, options_, detect_, context_));
    return out;
  }

  static void put_angles(const Calibration& own, const Positions& positions, double turn_rad,
                         Calibration& out) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      out.angles_rad[positions[i]] = own.angles_rad[i] - turn_rad;
      out.angle_sigma_rad[positions[i]] = own.angle_sigma_rad[i];
    }
  }

  Result<> put_stretch(const Positions& positions, const SensorMotion& main, Calibration& out) {
    const auto& frames = sequence_.frames();
    const std::string which = fmt::format(
        "the {} frames from {} on, beside which the recording was "
        "resumed,",
        positions.size(), frames[positions.front()].index);
    TURNSCAN_ASSIGN(const auto placed, placed_on(main, positions));
    if (placed) {
      put_angles(placed->own, positions, placed->turn_rad, out);
      out.notes.push_back(fmt::format("{} were placed by the surface that they show", which));
    } else {
      out.left_out.insert(out.left_out.end(), positions.begin(), positions.end());
      out.notes.push_back(
          fmt::format("{} were left out: they do not show how far the table had turned", which));
    }
    return {};
  }

  struct Placed {
    Calibration own;
    double turn_rad;
  };

  /// nullopt: what the stretch shows does not determine it.
  Result<std::optional<Placed>> placed_on(const SensorMotion& main,
                                          const Positions& positions) const {
    if (main.model.empty()) return std::nullopt;
    SequenceView view(sequence_, positions);
    SequenceHeader header = sequence_.header();
    header.turntable = main.calibration.table;
    view.set_header(std::move(header));
    auto own = calibrated(view);
    if (!own) return unless_cancelled(own.error());
    if (own->calibration.table.axis.dot(main.calibration.table.axis) < 0.0) return std::nullopt;
    auto yaw = find_relative_yaw(main, *own, context_);
    if (!yaw) return unless_cancelled(yaw.error());
    // A round object may be turned in any way.
    const auto& missing = main.calibration.undetermined;
    const bool round = std::find(missing.begin(), missing.end(), "angles") != missing.end();
    if (!yaw->determined && !round) return std::nullopt;
    return Placed{std::move(own->calibration), yaw->turn_rad};
  }

  static Result<std::optional<Placed>> unless_cancelled(const Error& error) {
    if (error.code == ErrorCode::kCancelled) return tl::unexpected<Error>(error);
    return std::nullopt;
  }

  const FrameSequence& sequence_;
  const FromMotionOptions& options_;
  const DetectOptions& detect_;
  const RunContext& context_;
  std::vector<Positions> stretches_;
};

}  // namespace

Result<Calibration> calibrate_stretches(const FrameSequence& sequence,
                                        const FromMotionOptions& options,
                                        const DetectOptions& detect, const RunContext& context) {
  return StretchMerger(sequence, options, detect, context).run();
}

}  // namespace turnscan::motion
