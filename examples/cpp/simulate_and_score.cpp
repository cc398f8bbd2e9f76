// simulate_and_score: scans a virtual object with two voxel sizes, and compares the meshes with the
// truth.

#include <cstdio>
#include <turnscan/turnscan.hpp>

turnscan::Result<> run() {
  TURNSCAN_ASSIGN(const auto simulated,
                  turnscan::simulate("builtin:letter-a", {{"scanner", "kinect-v2"},
                                                          {"frames", "60"},
                                                          {"height", "200mm"},
                                                          {"noise", "gaussian:1mm"}}));
  for (const std::string voxel_size : {"3mm", "6mm"}) {
    TURNSCAN_ASSIGN(const auto scan,
                    turnscan::reconstruct(simulated.frames(), {{"voxel-size", voxel_size}}));
    TURNSCAN_ASSIGN(const turnscan::Evaluation figures,
                    simulated.evaluate(scan.objects().front().mesh, {{"thresholds", "1mm"}}));
    std::printf("voxel size %s: median error %.2f mm, F at 1 mm %.3f\n", voxel_size.c_str(),
                1e3 * figures.accuracy.median, figures.scores.front().f);
  }
  return {};
}

int main() {
  const auto done = run();
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
