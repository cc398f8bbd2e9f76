#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {

namespace {

constexpr double kLowest_m = 0.003;  ///< above the floor
constexpr float kAverageOver_m = 0.006f;
constexpr float kRoundSlope = 0.25f;  ///< inwards per length downwards
constexpr float kReach_m = 0.03f;     ///< from the observed surface
constexpr float kMaxSlope = 4.0f;
constexpr std::size_t kFewestHeights = 10;  ///< of which a tenth is left out at both ends
constexpr double kFinest = 0.1;             ///< of a cell, without noise

/// Points on the lowest observed surface, projected to y = 0, with their inward slope per length
/// downwards.
struct LowestSurface {
  std::vector<Vec3f> points;
  std::vector<float> slopes;
};

class LowestSurfaceSearch {
 public:
  LowestSurfaceSearch(const Volume& volume, int floor)
      : volume_(volume), samples_(volume), floor_(floor) {}

  LowestSurface run() {
    const auto& size = samples_.size();
    const int layers = std::max(2, int(std::lround(kLowest_m / volume_.cell_m)));
    for (int k = 1; k + 2 < size[2]; ++k) {
      for (int j = floor_ + 1; j <= floor_ + layers && j + 1 < size[1]; ++j) {
        for (int i = 1; i + 2 < size[0]; ++i) {
          add_crossing({i, j, k}, {i + 1, j, k});
          add_crossing({i, j, k}, {i, j, k + 1});
        }
      }
    }
    return std::move(out_);
  }

 private:
  bool known(int i, int j, int k) const {
    const std::ptrdiff_t s = samples_.at(i, j, k);
    return s >= 0 && volume_.weight[std::size_t(s)] > 0.0f;
  }

  /// Adds the surface between two samples of which one is inside, with the gradient of the field.
  void add_crossing(const GridCoords& a, const GridCoords& b) {
    const float from = samples_.value(a[0], a[1], a[2]), to = samples_.value(b[0], b[1], b[2]);
    if ((from < 0.0f) == (to < 0.0f)) return;
    float down = 0.0f, across = 0.0f;
    for (const GridCoords& s : {a, b}) {
      const int i = s[0], j = s[1], k = s[2];
      if (!known(i, j - 1, k) || !known(i, j + 1, k) || !known(i, j, k)) return;
      const auto slope = [&](int di, int dj, int dk) {
        return samples_.value(i + di, j + dj, k + dk) - samples_.value(i - di, j - dj, k - dk);
      };
      down -= slope(0, 1, 0);
      across += std::hypot(slope(1, 0, 0), slope(0, 0, 1));
    }
    const Vec3d p = 0.5 * (volume_.position(a[0], a[1], a[2]) + volume_.position(b[0], b[1], b[2]));
    out_.points.emplace_back(float(p.x()), 0.0f, float(p.z()));
    out_.slopes.push_back(std::clamp(down / std::max(across, 1e-9f), -kMaxSlope, kMaxSlope));
  }

  const Volume& volume_;
  VolumeSamples samples_;
  int floor_;
  LowestSurface out_;
};

/// Heights between which four fifths of them lie.
struct HeightRange {
  double low_m = 0.0, high_m = 0.0;
  double spread_m() const { return high_m - low_m; }
};

/// nullopt: too few.
std::optional<HeightRange> range_of(std::vector<double> heights) {
  if (heights.size() < kFewestHeights) return std::nullopt;
  const auto tenth = std::ptrdiff_t(heights.size() / 10);
  std::sort(heights.begin(), heights.end());
  return HeightRange{heights.begin()[tenth], heights.rbegin()[tenth]};
}

enum class Known : std::uint8_t { kNothing, kFree, kInside };

class HollowFloorSearch {
 public:
  explicit HollowFloorSearch(const Volume& volume)
      : v_(volume),
        samples_(volume),
        width_(samples_.size()[0]),
        depth_(samples_.size()[2]),
        floors_(std::size_t(width_) * std::size_t(depth_), 0),
        found_(floors_.size(), 0),
        through_(floors_.size(), 0),
        layer_(floors_.size()) {}

  std::vector<std::uint8_t> unseen(int floor) {
    for (int j = floor; j < samples_.size()[1]; ++j) {
      look_at(j);
      for (std::size_t c = 0; c < layer_.size(); ++c)
        through_[c] = layer_[c] == Known::kFree && (j == floor || through_[c] != 0) ? 1 : 0;
      if (j == floor) free_at_floor_ = through_;
      add_hollows();
    }
    return std::move(floors_);
  }

  /// Empty if there is none.
  std::vector<std::uint8_t> measured(int floor) {
    if (floor >= samples_.size()[1]) return {};
    look_at(floor);
    std::vector<std::uint8_t> visited(layer_.size(), 0);
    std::vector<double> beside;
    std::vector<std::vector<std::size_t>> hollows;
    for (std::size_t c = 0; c < layer_.size(); ++c) {
      if (visited[c] || layer_[c] == Known::kInside) continue;
      std::vector<std::size_t> region = region_of(c, visited);
      if (reaches_border(region)) {
        const std::vector<double> heights = heights_below(floor, region);
        beside.insert(beside.end(), heights.begin(), heights.end());
      } else if (region.size() >= kFewestHeights) {
        hollows.push_back(std::move(region));
      }
    }
    const std::optional<HeightRange> platter = range_of(std::move(beside));
    if (!platter) return {};
    const double flat_m = std::max(platter->spread_m(), kFinest * v_.cell_m);
    bool any = false;
    for (const std::vector<std::size_t>& hollow : hollows) {
      const auto range = range_of(heights_below(floor, away_from_walls(hollow)));
      if (!range || range->low_m <= platter->high_m || range->spread_m() > flat_m) continue;
      for (const std::size_t c : hollow) floors_[c] = 1;
      any = true;
    }
    return any ? std::move(floors_) : std::vector<std::uint8_t>();
  }

 private:
  void look_at(int layer) {
    for (int k = 0; k < depth_; ++k)
      for (int i = 0; i < width_; ++i) layer_[at(i, k)] = known(i, layer, k);
  }

  /// The columns of a region that are farther than the truncation distance from what is inside:
  /// nearer to a wall the field mixes its depths with those below.
  std::vector<std::size_t> away_from_walls(const std::vector<std::size_t>& region) const {
    const int reach = int(std::ceil(v_.truncation_m / v_.cell_m));
    const auto is_away = [&](std::size_t c) {
      const int i = int(c % std::size_t(width_)), k = int(c / std::size_t(width_));
      for (int z = std::max(0, k - reach); z <= std::min(depth_ - 1, k + reach); ++z)
        for (int x = std::max(0, i - reach); x <= std::min(width_ - 1, i + reach); ++x)
          if (std::hypot(x - i, z - k) <= reach && layer_[at(x, z)] == Known::kInside) return false;
      return true;
    };
    std::vector<std::size_t> out;
    std::copy_if(region.begin(), region.end(), std::back_inserter(out), is_away);
    return out;
  }

  /// Heights of the surface that was measured below a layer, in the columns that are free in it.
  std::vector<double> heights_below(int layer, const std::vector<std::size_t>& region) const {
    std::vector<double> out;
    for (const std::size_t c : region) {
      const int i = int(c % std::size_t(width_)), k = int(c / std::size_t(width_));
      for (int j = layer; j > 0 && known(i, j, k) == Known::kFree; --j) {
        if (known(i, j - 1, k) != Known::kInside) continue;
        const float above = samples_.value(i, j, k), below = samples_.value(i, j - 1, k);
        const double up = double(-below) / double(above - below);
        out.push_back(v_.position(i, j - 1, k).y() + up * v_.cell_m);
      }
    }
    return out;
  }

  std::size_t at(int i, int k) const {
    return std::size_t(i) + std::size_t(width_) * std::size_t(k);
  }

  Known known(int i, int j, int k) const {
    const std::ptrdiff_t s = samples_.at(i, j, k);
    if (s >= 0 && !(v_.weight[std::size_t(s)] > 0.0f)) return Known::kNothing;
    const float value = s >= 0 ? v_.value[std::size_t(s)] : v_.uniform[samples_.brick(i, j, k)];
    if (s < 0 && value == 0.0f) return Known::kNothing;
    return value < 0.0f ? Known::kInside : Known::kFree;
  }

  /// The columns that are connected with one of them within the layer, without those inside.
  std::vector<std::size_t> region_of(std::size_t start, std::vector<std::uint8_t>& visited) const {
    std::vector<std::size_t> out{start};
    visited[start] = 1;
    for (std::size_t n = 0; n < out.size(); ++n) {
      const int i = int(out[n] % std::size_t(width_)), k = int(out[n] / std::size_t(width_));
      for (const auto& [x, z] :
           {std::pair(i - 1, k), std::pair(i + 1, k), std::pair(i, k - 1), std::pair(i, k + 1)}) {
        if (x < 0 || z < 0 || x >= width_ || z >= depth_) continue;
        const std::size_t next = at(x, z);
        if (visited[next] || layer_[next] == Known::kInside) continue;
        visited[next] = 1;
        out.push_back(next);
      }
    }
    return out;
  }

  bool reaches_border(const std::vector<std::size_t>& region) const {
    return std::any_of(region.begin(), region.end(), [&](std::size_t c) {
      const int i = int(c % std::size_t(width_)), k = int(c / std::size_t(width_));
      return i == 0 || k == 0 || i == width_ - 1 || k == depth_ - 1;
    });
  }

  void add_hollows() {
    std::vector<std::uint8_t> visited(layer_.size(), 0);
    for (std::size_t c = 0; c < layer_.size(); ++c) {
      if (visited[c] || layer_[c] == Known::kInside) continue;
      const std::vector<std::size_t> region = region_of(c, visited);
      if (reaches_border(region)) continue;
      const auto count = [&](const auto& of) {
        return std::size_t(std::count_if(region.begin(), region.end(), of));
      };
      const bool hollow = count([&](std::size_t r) { return layer_[r] == Known::kFree; }) > 0 &&
                          count([&](std::size_t r) { return through_[r] != 0; }) == 0;
      const bool again = 2 * count([&](std::size_t r) { return found_[r] != 0; }) > region.size();
      if (!hollow || again) continue;
      for (const std::size_t r : region) {
        found_[r] = 1;
        floors_[r] = 1 - free_at_floor_[r];
      }
    }
  }

  const Volume& v_;
  VolumeSamples samples_;
  int width_, depth_;
  std::vector<std::uint8_t> floors_;
  std::vector<std::uint8_t> found_;  ///< in the lowest layer of a hollow
  std::vector<std::uint8_t> free_at_floor_;
  std::vector<std::uint8_t> through_;  ///< free from the floor up to the current layer
  std::vector<Known> layer_;
};

}  // namespace

PlatterColumns::PlatterColumns(const Volume& volume)
    : origin_m_(volume.origin_m),
      cell_m_(volume.cell_m),
      width_(VolumeSamples(volume).size()[0]),
      depth_(VolumeSamples(volume).size()[2]) {}

bool PlatterColumns::contains(const Vec3f& p) const {
  const Vec3d at = (p.cast<double>() - origin_m_) / cell_m_;
  const int i = int(std::lround(at.x())), k = int(std::lround(at.z()));
  return i >= 0 && k >= 0 && i < width_ && k < depth_ && column(i, k);
}

MeasuredFloors::MeasuredFloors(const Volume& volume, int floor) : PlatterColumns(volume) {
  columns_ = HollowFloorSearch(volume).measured(floor);
}

bool MeasuredFloors::contains(const Vec3f& p) const {
  return double(p.y()) > kFinest * cell_m_ && PlatterColumns::contains(p);
}

TaperedFoot::TaperedFoot(const Volume& volume, int floor) : PlatterColumns(volume) {
  const LowestSurface lowest = LowestSurfaceSearch(volume, floor).run();
  const KdTree tree(lowest.points);
  std::vector<std::uint8_t> round(lowest.points.size());
  std::vector<std::pair<std::uint32_t, float>> near;
  for (std::size_t n = 0; n < round.size(); ++n) {
    tree.radius(lowest.points[n], kAverageOver_m, near);
    float sum = 0.0f;
    for (const auto& [other, squared] : near) sum += lowest.slopes[other];
    round[n] = sum > kRoundSlope * float(near.size()) ? 1 : 0;
  }
  if (std::find(round.begin(), round.end(), 1) == round.end()) return;
  columns_.assign(std::size_t(width_) * std::size_t(depth_), 0);
  for (int k = 0; k < depth_; ++k) {
    for (int i = 0; i < width_; ++i) {
      Vec3f p = volume.position(i, 0, k).cast<float>();
      p.y() = 0.0f;
      std::uint32_t nearest = 0;
      float squared = 0.0f;
      if (tree.knn(p, 1, &nearest, &squared, kReach_m) == 1)
        columns_[std::size_t(i) + std::size_t(width_) * std::size_t(k)] = round[nearest];
    }
  }
}

std::vector<std::uint8_t> hollow_floors(const Volume& volume, int floor) {
  return HollowFloorSearch(volume).unseen(floor);
}

}  // namespace turnscan::tsdf
