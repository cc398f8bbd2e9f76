#include <turnscan/workflow/calibration/reduced_frames.hpp>

namespace turnscan::workflow {

namespace {

constexpr double kMostPixels = 1.6e6;

int step_of(const CameraIntrinsics& camera) {
  int step = 1;
  while (double(camera.width) * double(camera.height) > kMostPixels * step * step) ++step;
  return step;
}

/// Pixels 0, step, 2 step, ... of either direction.
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

SequenceView reduced_frames(const FrameSequence& sequence) {
  SequenceView out(sequence);
  SequenceHeader header = sequence.header();
  std::vector<int> steps;
  for (SensorInfo& sensor : header.sensors) {
    const bool images = sensor.kind == SensorKind::kDepthCamera;
    steps.push_back(images ? step_of(sensor.intrinsics) : 1);
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

}  // namespace turnscan::workflow
