// How tightly neighbouring views of a recording lie on each other. Usage:
// calibration_views RECORDING [CALIBRATION.json]

#include <fmt/format.h>

#include <algorithm>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace {

using namespace turnscan;

int fail_with(const Error& error) {
  fmt::print("{}\n", error.text());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const auto recording = Recording::open(argv[1]);
  if (!recording) return fail_with(recording.error());
  Calibration calibration;
  std::unique_ptr<FrameSequence> seen;
  if (argc > 2) {
    const auto read = read_calibration(argv[2]);
    if (!read) return fail_with(read.error());
    auto with = with_calibration(*recording, *read);
    if (!with) return fail_with(with.error());
    seen = std::move(*with);
  }
  const FrameSequence& sequence = seen ? *seen : static_cast<const FrameSequence&>(*recording);
  const auto poses = frame_poses(sequence.header(), sequence.frames(), std::nullopt);
  if (!poses) return fail_with(poses.error());
  Cylinder cylinder;
  cylinder.margin_m = 0.006;
  cylinder.radius_m = 0.1;
  const RayTable rays(sequence.header().sensors[0].intrinsics);
  std::vector<std::vector<Vec3f>> clouds;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const auto frame = sequence.read(i);
    if (!frame) return fail_with(frame.error());
    const auto points = points_of(*frame, sequence.header().sensors[0], rays);
    if (!points) return fail_with(points.error());
    std::vector<Vec3f> cloud;
    const Pose& pose = poses->T_table_sensor[i];
    for (const Vec3f& p : crop(*points, SensorCrop(cylinder, pose)).cloud.points)
      cloud.push_back((pose * p.cast<double>()).cast<float>());
    clouds.push_back(std::move(cloud));
  }
  std::vector<float> all;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const KdTree tree(clouds[(i + 1) % clouds.size()]);
    for (const Vec3f& p : clouds[i]) {
      std::uint32_t index = 0;
      float squared = 0.0f;
      // What only one of the views sees has no partner.
      if (tree.knn(p, 1, &index, &squared) == 1 && squared < 1e-4f)
        all.push_back(std::sqrt(squared));
    }
  }
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  fmt::print("median distance of neighbouring views {:.3f} mm over {} points\n", *middle * 1e3,
             all.size());
}
