// The input is frames.csv of a recording with two sensors and one frame of each.

#include <turnscan/recording/recording.hpp>

#include "tests/fuzz/scratch_folder.hpp"

namespace {

/// A recording with the frames depth/000000.png and points/000001.ply.
bool lay_out(const std::filesystem::path& path) {
  using namespace turnscan;
  SequenceHeader header;
  header.sensors.resize(2);
  CameraIntrinsics& camera = header.sensors[0].intrinsics;
  camera.width = 4;
  camera.height = 3;
  camera.fx = camera.fy = 5.0;
  header.sensors[1].kind = SensorKind::kPointScanner;
  Frame depth, scan;
  depth.depth = DepthImage(4, 3, 1000);
  scan.info.index = 1;
  scan.info.sensor = 1;
  scan.points.points = {Vec3f(0.1f, 0.2f, 0.3f)};
  auto writer = RecordingWriter::create(path, header);
  return writer && writer->append(depth) && writer->append(scan) && writer->finish();
}

}  // namespace

TURNSCAN_FUZZ_TARGET(recording_table) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = lay_out(folder / "r");
  fuzz::require(laid_out, "a recording");
  folder.put("r/frames.csv", fuzz::text_of(data, size));
  const auto recording = Recording::open(folder / "r");
  if (recording) fuzz::check(*recording);
  return 0;
}
