#include <turnscan/workflow/calibration/reduced_frames.hpp>

#include <algorithm>

namespace turnscan::workflow {

namespace {

int step_of(const SensorInfo& sensor, double most_pixels) {
  if (sensor.kind != SensorKind::kDepthCamera) return 1;
  const CameraIntrinsics& camera = sensor.intrinsics;
  int step = 1;
  while (double(camera.width) * double(camera.height) > most_pixels * step * step) ++step;
  return step;
}

/// Keeps pixels 0, step, 2 step, ... in both directions.
CameraIntrinsics reduced(CameraIntrinsics camera, int step) {
  camera.width = (camera.width + step - 1) / step;
  camera.height = (camera.height + step - 1) / step;
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value /= step;
  return camera;
}

DepthImage reduced(const DepthImage& depth, int step) {
  DepthImage out((depth.width + step - 1) / step, (depth.height + step - 1) / step);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.at(x, y) = depth.at(step * x, step * y);
  return out;
}

}  // namespace

SequenceView reduced_frames(const FrameSequence& sequence, double most_pixels) {
  SequenceView out(sequence);
  SequenceHeader header = sequence.header();
  std::vector<int> steps;
  for (SensorInfo& sensor : header.sensors) {
    steps.push_back(step_of(sensor, most_pixels));
    if (steps.back() > 1) sensor.intrinsics = reduced(sensor.intrinsics, steps.back());
  }
  out.set_header(std::move(header));
  out.set_map([steps](Frame frame, std::size_t) -> Result<Frame> {
    const int step = frame.info.sensor < steps.size() ? steps[frame.info.sensor] : 1;
    if (step == 1 || frame.depth.empty()) return frame;
    frame.depth = reduced(frame.depth, step);
    frame.color = {};
    frame.color_jpeg.clear();
    return frame;
  });
  return out;
}

bool are_coarser_for_checks(const SequenceHeader& header) {
  return std::any_of(header.sensors.begin(), header.sensors.end(), [](const SensorInfo& sensor) {
    return step_of(sensor, kPixelsToCheck) > step_of(sensor, kPixelsToCalibrate);
  });
}

}  // namespace turnscan::workflow
