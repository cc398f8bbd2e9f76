#include <tests/reconstruction/retreating_outlines.hpp>
#include <turnscan/reconstruction/views/depth_window.hpp>

namespace turnscan::testing {

double carton(const Vec3d& o, const Vec3d& d) {
  return to_box(o, d, Vec3d(-0.035, 0.0, -0.015), Vec3d(0.035, 0.08, 0.015));
}

MemorySequence with_retreating_outlines(MemorySequence sequence, int pixels) {
  constexpr int kStep = 120;  // 12 mm
  for (std::size_t f = 0; f < sequence.data.size(); f += 3) {
    DepthImage& depth = sequence.data[f].depth;
    for (int round = 0; round < pixels; ++round) {
      const DepthImage before = depth;
      for (int y = 0; y < depth.height; ++y) {
        for (int x = 1; x + 1 < depth.width; ++x) {
          const auto own = before.at(x, y);
          for (const auto beside : {before.at(x - 1, y), before.at(x + 1, y)})
            if (views::measured(own) && views::measured(beside) && beside > own + kStep)
              depth.at(x, y) = beside;
        }
      }
    }
  }
  return sequence;
}

}  // namespace turnscan::testing
