#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/quality/hollow.hpp>

namespace turnscan::quality {

namespace {

constexpr int kCells = 160;  ///< along the longer horizontal side
/// Where the mesh begins, in cells: so that lines miss the edges of regular meshes.
constexpr double kFirst_x = 1.5137, kFirst_z = 1.4721;
constexpr std::size_t kHollowViews = 48;
constexpr double kMostOfFloor = 0.5;  ///< share of a hollow whose floor is unknown
constexpr float kNowhere = -std::numeric_limits<float>::infinity();

/// Crossings of the mesh with vertical lines through the cells of a horizontal grid.
class Columns {
 public:
  Columns(const TriangleMesh& mesh, std::span<const Evidence> evidence)
      : box_(bounds(mesh.vertices)) {
    const Vec3d size = box_.size();
    cell_m_ = std::max({size.x(), size.z(), 1e-6}) / double(kCells - 4);
    width_ = int(size.x() / cell_m_) + 4, depth_ = int(size.z() / cell_m_) + 4;
    heights_.resize(std::size_t(width_) * std::size_t(depth_));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& t = mesh.triangles[i];
      add(at(mesh.vertices[t[0]]), at(mesh.vertices[t[1]]), at(mesh.vertices[t[2]]),
          evidence[i] == Evidence::kInvented);
    }
    for (auto& column : heights_) std::sort(column.begin(), column.end());
  }

  int width() const { return width_; }
  int depth() const { return depth_; }
  std::size_t size() const { return heights_.size(); }
  double cell_m() const { return cell_m_; }
  float top(std::size_t i) const {
    return heights_[i].empty() ? kNowhere : heights_[i].back().height;
  }
  bool top_invented(std::size_t i) const { return heights_[i].back().invented; }
  double lowest_m() const { return box_.min.y(); }

  bool inside(std::size_t i, float y) const {
    const auto above = std::lower_bound(heights_[i].begin(), heights_[i].end(), Crossing{y, false});
    return (above - heights_[i].begin()) % 2 == 1;
  }
  Vec3d place(std::size_t i, double y) const {
    const auto w = std::size_t(width_);
    return {box_.min.x() + cell_m_ * (double(i % w) - kFirst_x), y,
            box_.min.z() + cell_m_ * (double(i / w) - kFirst_z)};
  }
  template <class Use>
  void beside(std::size_t i, const Use& use) const {
    const int x = int(i) % width_, z = int(i) / width_;
    if (x > 0) use(i - 1);
    if (x + 1 < width_) use(i + 1);
    if (z > 0) use(i - std::size_t(width_));
    if (z + 1 < depth_) use(i + std::size_t(width_));
  }

 private:
  struct Crossing {
    float height;
    bool invented;
    bool operator<(const Crossing& other) const { return height < other.height; }
  };

  /// In cells, with the height in metres.
  Vec3d at(const Vec3f& p) const {
    return {(double(p.x()) - box_.min.x()) / cell_m_ + kFirst_x, double(p.y()),
            (double(p.z()) - box_.min.z()) / cell_m_ + kFirst_z};
  }

  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c, bool invented) {
    const double area = (b.x() - a.x()) * (c.z() - a.z()) - (c.x() - a.x()) * (b.z() - a.z());
    if (area == 0.0) return;
    const auto range = [](double u, double v, double w) {
      return std::pair{int(std::ceil(std::min({u, v, w}))), int(std::floor(std::max({u, v, w})))};
    };
    const auto [x0, x1] = range(a.x(), b.x(), c.x());
    const auto [z0, z1] = range(a.z(), b.z(), c.z());
    for (int z = z0; z <= z1; ++z)
      for (int x = x0; x <= x1; ++x) {
        const double u = ((b.x() - x) * (c.z() - z) - (c.x() - x) * (b.z() - z)) / area;
        const double v = ((c.x() - x) * (a.z() - z) - (a.x() - x) * (c.z() - z)) / area;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        heights_[std::size_t(z) * std::size_t(width_) + std::size_t(x)].push_back(
            {float(u * a.y() + v * b.y() + (1.0 - u - v) * c.y()), invented});
      }
  }

  Box box_;
  double cell_m_ = 1.0;
  int width_ = 0, depth_ = 0;
  std::vector<std::vector<Crossing>> heights_;
};

/// Height to which water would stand on the columns (Barnes, Lehman and Mulla 2014): it runs off
/// where there is no mesh.
std::vector<float> water_level(const Columns& columns) {
  std::vector<float> out(columns.size(), std::numeric_limits<float>::infinity());
  using Level = std::pair<float, std::size_t>;
  std::priority_queue<Level, std::vector<Level>, std::greater<>> open;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (columns.top(i) == kNowhere) open.emplace(out[i] = kNowhere, i);
  while (!open.empty()) {
    const auto [level, i] = open.top();
    open.pop();
    columns.beside(i, [&](std::size_t k) {
      if (!std::isinf(out[k]) || out[k] < 0.0f) return;
      open.emplace(out[k] = std::max(level, columns.top(k)), k);
    });
  }
  return out;
}

class HollowSearch {
 public:
  HollowSearch(const TriangleMesh& mesh, std::span<const Evidence> evidence,
               std::span<const views::DepthView> views, double lower_by_m)
      : columns_(mesh, evidence), level_(water_level(columns_)), lower_by_m_(float(lower_by_m)) {
    for (const std::size_t i : evenly_spread(views.size(), kHollowViews))
      viewpoints_.push_back(views[i].viewpoint());
  }

  double run() {
    find_floors();
    double volume_m3 = 0.0;
    for (const std::vector<std::size_t>& cells : hollows()) {
      std::vector<std::uint8_t> hollow(columns_.size(), 0), floor = hollow;
      for (const std::size_t i : cells) hollow[i] = 1, floor[i] = floor_[i];
      const auto unknown = double(std::count(floor.begin(), floor.end(), 1));
      if (unknown >= kMostOfFloor * double(cells.size()))
        volume_m3 += volume_below(floor, wall(hollow));
    }
    return volume_m3;
  }

 private:
  /// The cells of each connected hollow.
  std::vector<std::vector<std::size_t>> hollows() const {
    std::vector<std::vector<std::size_t>> out;
    std::vector<std::uint8_t> done(columns_.size(), 0);
    for (std::size_t start = 0; start < done.size(); ++start) {
      if (done[start] != 0 || !deep(start)) continue;
      std::vector<std::size_t> cells{start};
      done[start] = 1;
      for (std::size_t k = 0; k < cells.size(); ++k)
        columns_.beside(cells[k], [&](std::size_t i) {
          if (done[i] != 0 || !deep(i)) return;
          done[i] = 1;
          cells.push_back(i);
        });
      out.push_back(std::move(cells));
    }
    return out;
  }

  bool deep(std::size_t i) const { return columns_.top(i) != kNowhere && hollow(i) >= lower_by_m_; }
  float hollow(std::size_t i) const { return level_[i] - columns_.top(i); }

  void find_floors() {
    std::vector<float> lowered(columns_.size());
    for (std::size_t i = 0; i < lowered.size(); ++i)
      lowered[i] = columns_.top(i) - (deep(i) ? lower_by_m_ : 0.0f);
    parallel_for(floor_.size(), 64, [&](std::size_t i) {
      if (!deep(i)) return;
      floor_[i] = columns_.top_invented(i) ||
                  std::none_of(viewpoints_.begin(), viewpoints_.end(),
                               [&](const Viewpoint& from) { return seen(lowered, i, from); });
    });
  }

  /// Whether nothing on the surface hides a column's top from a viewpoint.
  bool seen(const std::vector<float>& surface, std::size_t i, const Viewpoint& from) const {
    const Vec3d to = from.direction_from(columns_.place(i, surface[i]));
    const double across = std::hypot(to.x(), to.z());
    if (!(to.y() > 0.0)) return false;
    if (across < 1e-9) return true;
    const auto w = std::size_t(columns_.width());
    const auto x = double(i % w), z = double(i / w);
    const auto rise = float(to.y() / across * columns_.cell_m());
    for (int step = 1;; ++step) {
      const int u = int(std::lround(x + step * to.x() / across)),
                v = int(std::lround(z + step * to.z() / across));
      if (u < 0 || v < 0 || u >= columns_.width() || v >= columns_.depth()) return true;
      if (surface[std::size_t(v) * w + std::size_t(u)] > surface[i] + float(step) * rise)
        return false;
    }
  }

  /// In cells, from what is within to the nearest that is not (a chamfer distance). Cells at the
  /// border are outside, so that it does not matter that the ends of rows are neighbours here.
  std::vector<float> distance_to_outside(const std::vector<std::uint8_t>& within) const {
    std::vector<float> out(within.size());
    const auto w = std::ptrdiff_t(columns_.width());
    const auto n = std::ptrdiff_t(within.size());
    constexpr float kDiagonal = std::numbers::sqrt2_v<float>;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = within[i] != 0 ? 1e6f : 0.0f;
    const auto relax = [&](std::ptrdiff_t i, std::ptrdiff_t k, float step) {
      if (k >= 0 && k < n)
        out[std::size_t(i)] = std::min(out[std::size_t(i)], out[std::size_t(k)] + step);
    };
    for (const std::ptrdiff_t sign : {-1, 1})
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::ptrdiff_t i = sign < 0 ? k : n - 1 - k;
        relax(i, i + sign, 1.0f), relax(i, i + sign * w, 1.0f);
        relax(i, i + sign * (w + 1), kDiagonal), relax(i, i + sign * (w - 1), kDiagonal);
      }
    return out;
  }

  /// In cells: how thick the wall about a hollow is, below its rim; nullopt unless it is thinner
  /// than the hollow is wide.
  std::optional<float> wall(const std::vector<std::uint8_t>& hollow) const {
    const std::vector<float> wide = distance_to_outside(hollow);
    float rim = kNowhere;
    for (std::size_t i = 0; i < hollow.size(); ++i)
      if (hollow[i] != 0) rim = std::max(rim, level_[i]);
    std::vector<std::uint8_t> within(hollow);
    for (std::size_t i = 0; i < within.size(); ++i)
      if (columns_.top(i) >= rim - lower_by_m_) within[i] = 1;
    const std::vector<float> outside = distance_to_outside(within);
    std::vector<float> thickness;
    for (std::size_t i = 0; i < hollow.size(); ++i)
      if (hollow[i] != 0 && wide[i] <= 1.0f) thickness.push_back(outside[i]);
    const auto thick = float(median(thickness));
    if (thick > *std::max_element(wide.begin(), wide.end())) return std::nullopt;
    return thick;
  }

  /// Of what is inside the mesh below the floors, in layers.
  double volume_below(const std::vector<std::uint8_t>& floor, std::optional<float> thick) const {
    const double step = columns_.cell_m();
    double highest = columns_.lowest_m();
    for (std::size_t i = 0; i < floor.size(); ++i)
      if (floor[i] != 0) highest = std::max(highest, double(columns_.top(i)));
    std::vector<std::uint8_t> above(columns_.size(), 0), inside(columns_.size(), 0);
    double cells = 0.0;
    for (double y = highest - 0.5 * step; y > columns_.lowest_m(); y -= step) {
      for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = columns_.inside(i, float(y));
      std::vector<std::uint8_t> here(inside.size(), 0);
      std::vector<std::size_t> open;
      const auto reach = [&](std::size_t i) {
        if (here[i] != 0) return;
        here[i] = 1;
        open.push_back(i);
      };
      for (std::size_t i = 0; i < inside.size(); ++i)
        if (inside[i] != 0 && (above[i] != 0 || (floor[i] != 0 && y < columns_.top(i)))) reach(i);
      if (thick) {
        const std::vector<float> deep = distance_to_outside(inside);
        while (!open.empty()) {
          const std::size_t i = open.back();
          open.pop_back();
          columns_.beside(i, [&](std::size_t k) {
            if (deep[k] > *thick) reach(k);
          });
        }
      }
      cells += double(std::count(here.begin(), here.end(), 1));
      above = std::move(here);
    }
    return cells * step * step * step;
  }

  Columns columns_;
  std::vector<float> level_;
  float lower_by_m_;
  std::vector<Viewpoint> viewpoints_;
  std::vector<std::uint8_t> floor_ = std::vector<std::uint8_t>(columns_.size(), 0);
};

}  // namespace

double unknown_volume_m3(const TriangleMesh& mesh, std::span<const Evidence> evidence,
                         std::span<const views::DepthView> views, double lower_by_m) {
  if (mesh.triangles.empty() || views.empty()) return 0.0;
  return HollowSearch(mesh, evidence, views, lower_by_m).run();
}

}  // namespace turnscan::quality
