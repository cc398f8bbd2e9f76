// live_sensor URI MESH: integrates the frames of a sensor as they arrive. Without a device:
//   live_sensor 'virtual:letter-a?calibration=true&angles=1&frames=60' letter.ply

#include <cstdio>
#include <turnscan/turnscan.hpp>

turnscan::Result<> run(const std::string& uri, const std::string& mesh) {
  const turnscan::RunContext context;
  TURNSCAN_ASSIGN(const auto source, turnscan::open_source(uri, context));
  // The turntable must be known; for most devices it comes from a calibration file.
  TURNSCAN_ASSIGN(auto stream, turnscan::Stream::create(source->info().header));
  TURNSCAN_TRY(source->start());
  for (std::size_t count = 0;;) {
    TURNSCAN_ASSIGN(const turnscan::Delivery delivery, source->next(1.0, context));
    if (delivery.kind == turnscan::Delivery::Kind::kEnd) break;
    if (delivery.kind != turnscan::Delivery::Kind::kFrame) continue;
    TURNSCAN_TRY(stream.add(delivery.frame));
    if (++count % 20 != 0) continue;
    TURNSCAN_ASSIGN(const turnscan::TriangleMesh preview, stream.preview());
    std::printf("%zu frames; the preview has %zu triangles\n", count, preview.triangles.size());
  }
  TURNSCAN_ASSIGN(const auto scan, stream.finish());
  std::printf("%s\n", scan.objects().front().check.text().c_str());
  TURNSCAN_ASSIGN(const auto files, scan.write({.mesh = mesh}));
  std::printf("Wrote %s\n", files.front().c_str());
  return {};
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto done = run(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
