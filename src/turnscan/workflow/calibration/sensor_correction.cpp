#include <turnscan/workflow/calibration/sensor_correction.hpp>

#include <algorithm>
#include <array>
#include <turnscan/core/units.hpp>
#include <turnscan/io/import/iai_kinect2.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/depth/depth_bias.hpp>

namespace turnscan::workflow {

namespace {

std::optional<DepthCorrection>& depth_of(Calibration& calibration, std::size_t sensor) {
  return sensor == 0 ? calibration.depth : calibration.others[sensor - 1].depth;
}

/// Uses the ball if one is stated: its size is known better than a platter's.
Result<DepthGauge> gauge(const FrameSequence& recording, std::uint32_t sensor,
                         const CalibrateRequest& request, const RunContext& context) {
  const double recorded_m = recording.header().sensors[sensor].depth_bias_m;
  TURNSCAN_ASSIGN(const AveragedScan scan,
                  average_sensor(recording, sensor, request.average, context));
  if (!request.ball.diameter_m)
    return gauge_depth(scan, *request.detect.radius_m, recorded_m, request.detect, context);
  TURNSCAN_ASSIGN(const BallGauge ball,
                  gauge_depth_with_ball(scan, *request.ball.diameter_m, recorded_m, context));
  return ball.gauge;
}

Result<DepthCorrection> depth_from_gauge(const FrameSequence& recording, const Calibration& cameras,
                                         std::uint32_t sensor, const CalibrateRequest& request,
                                         const RunContext& context) {
  TURNSCAN_ASSIGN(const DepthGauge here, gauge(recording, sensor, request, context));
  if (!request.depth_also.empty()) {
    TURNSCAN_ASSIGN(const Recording opened, Recording::open(request.depth_also, context));
    TURNSCAN_ASSIGN(const SequenceView also, corrected_sequence(opened, cameras));
    if (also.header().sensors.size() != recording.header().sensors.size())
      return fail(ErrorCode::kInvalidOption,
                  "--depth-also: the recordings have different numbers of sensors; record both "
                  "with the same ones");
    if (also.header().sensors[sensor].depth_unit_m !=
        recording.header().sensors[sensor].depth_unit_m)
      return fail(ErrorCode::kInvalidOption,
                  "--depth-also: the recordings have depth in different units; record both with "
                  "the same sensor");
    TURNSCAN_ASSIGN(const DepthGauge there, gauge(also, sensor, request, context));
    return fit_depth(std::array{here, there});
  }
  DepthCorrection out;
  out.bias_m = here.offset_m;
  out.bias_sigma_m = here.sigma_m;
  out.found = request.ball.diameter_m
                  ? fmt::format("a ball of {}",
                                format_quantity(*request.ball.diameter_m, Quantity::kLength))
                  : fmt::format("the platter's rim, whose radius is {}",
                                format_quantity(*request.detect.radius_m, Quantity::kLength));
  return out;
}

}  // namespace

Result<SequenceView> corrected_sequence(const FrameSequence& sequence,
                                        const Calibration& correction) {
  SequenceHeader header = sequence.header();
  TURNSCAN_TRY(correct_sensors(correction, header.sensors));
  SequenceView out(sequence);
  out.set_header(std::move(header));
  return out;
}

Result<AveragedScan> average_sensor(const FrameSequence& sequence, std::uint32_t sensor,
                                    const AverageOptions& options, const RunContext& context) {
  return average_frames(sequence, spread_positions(sequence, sensor, std::size_t(options.frames)),
                        options, context);
}

Result<Calibration> sensor_correction(const FrameSequence& recording,
                                      const CalibrateRequest& request, const RunContext& context) {
  const std::size_t sensors = recording.header().sensors.size();
  if (request.iai_folders.size() > sensors)
    return fail(ErrorCode::kInvalidOption,
                "--iai-kinect2 is given {} times, but the recording has {} sensor{}",
                request.iai_folders.size(), sensors, sensors == 1 ? "" : "s");
  Calibration out;
  out.others.resize(std::max<std::size_t>(sensors, 1) - 1);
  for (std::size_t k = 0; k < request.iai_folders.size(); ++k) {
    TURNSCAN_ASSIGN(const Kinect2Calibration kinect, read_iai_kinect2(request.iai_folders[k]));
    depth_of(out, k) = kinect.depth;
    (k == 0 ? out.camera : out.others[k - 1].camera) = kinect.camera;
  }
  if (!request.depth_bias) return out;
  TURNSCAN_ASSIGN(const SequenceView calibrated, corrected_sequence(recording, out));
  const Calibration cameras = out;
  for (std::size_t k = 0; k < sensors; ++k) {
    auto depth = depth_from_gauge(calibrated, cameras, std::uint32_t(k), request, context);
    if (!depth && sensors > 1 && depth.error().code != ErrorCode::kCancelled)
      depth.error().message = fmt::format("sensor {}: {}", k, depth.error().message);
    TURNSCAN_ASSIGN(depth_of(out, k), std::move(depth));
  }
  return out;
}

void keep_corrections(const Calibration& correction, Calibration& found) {
  found.depth = correction.depth;
  found.camera = correction.camera;
  for (std::size_t k = 0; k < correction.others.size(); ++k) {
    const SensorPlace& other = correction.others[k];
    if (k < found.others.size()) {
      found.others[k].depth = other.depth;
      found.others[k].camera = other.camera;
    } else if (other.depth || other.camera) {
      found.notes.push_back(
          fmt::format("sensor {}: its corrections of depth and camera are not stored, because only "
                      "--from-motion determines its pose",
                      k + 1));
    }
  }
}

}  // namespace turnscan::workflow
