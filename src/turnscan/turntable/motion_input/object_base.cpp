#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/motion_input/object_base.hpp>
#include <unordered_map>

namespace turnscan::motion {

namespace {

constexpr double kMinCell_m = 0.006;      ///< edge of a cell that turns with the object
constexpr double kCellSpacings = 2.0;     ///< and at least this many pixel spacings
constexpr std::uint32_t kMinSupport = 3;  ///< frames that saw a cell
constexpr double kMinAround_rad = 20.0 * kRadiansPerDegree;  ///< between these
/// The motion uses no pixels of thin and rugged parts (a jaw, legs), which are all outline. If
/// nothing static is below, their cells count if this share of the frames saw them, which mixed
/// pixels at random depths do not reach, and only if they are this many cells below the rest; all
/// of them count if their support is this many times that of a static interpretation.
constexpr double kThinShare = 0.2, kThinCells = 3.0, kTurnsRather = 1.4;
constexpr double kMinStill = 20.0;  ///< pixels of the static surface below
constexpr std::size_t kTurningFrames = 48, kMaxPoints = 20000;
constexpr double kSlice_m = 0.002;
constexpr std::size_t kSlices = 204;
constexpr double kMinGap_m = 0.006;   ///< without a surface: the object has ended
constexpr double kGapRows = 1.8;      ///< and at least this many rows of pixels
constexpr double kMinWidth_m = 0.01;  ///< of a foot
constexpr std::size_t kSpreadSlices = 3;
constexpr double kSpreadShare = 0.12;  ///< share of its disc that is visible of a desk or a platter
constexpr double kSpreadColumns = 2.0;  ///< relative to an upright column of the same width
constexpr double kMinDesk_m = 0.05;     ///< minimum radius of a desk
constexpr double kAbove_m = 0.008;      ///< height up to which static surface may touch the turning
                                        ///< part
constexpr double kTouches_m = 0.01;     ///< from the turning part down to its supporting surface
constexpr double kFoot_m = 0.012;       ///< height above the base from which a column is followed
constexpr double kBelow_m = 0.06;       ///< depth below the base in which something stands still
constexpr int kMinBelow = 3;            ///< pixels of a column: mixed ones are fewer
constexpr double kSettled_m = 0.0005;   ///< a base is lowered in steps of at least this
constexpr std::size_t kMinEnds = 20;    ///< columns whose end was seen
/// Share of the ends that are below the base by noise.
constexpr double kLowestEnds = 0.08;
constexpr std::size_t kFrames = 15;
constexpr double kMinSeen = 0.7;  ///< share of the frames in which a static pixel is seen
/// Ratio of a pixel's inter-decile depth range to the noise: 2.6 if nothing moves.
constexpr double kStillSigmas = 4.0;

/// Heights above and distances from the axis' centre.
struct AxisFrame {
  Vec3d axis, center;

  double height(const Vec3d& p) const { return axis.dot(p - center); }
  double radius(const Vec3d& p) const { return axis.cross(p - center).norm(); }
};

constexpr double kNothing_m = 1e9;  ///< height if there are no points

struct TurningPoint {
  Vec3d p;             ///< sensor frame
  bool inner = false;  ///< inside the outline of the turning part
};

/// Lowest and outermost turning points.
struct Extent {
  double low_m = 0.0, reach_m = 0.0;
};

/// Cells of the turning frame, with the number and the angular range of the frames that saw each.
class TurningCells {
 public:
  TurningCells(const AxisFrame& frame, double cell_m) : frame_(frame), cell_m_(cell_m) {}

  void add(const std::vector<TurningPoint>& points, double angle_rad, std::uint32_t number) {
    const Eigen::AngleAxisd back(-angle_rad, frame_.axis);
    ++frames_;
    for (const auto& [p, inner] : points) {
      const Vec3d at = (back * (p - frame_.center)) / cell_m_;
      if (!(at.cwiseAbs().maxCoeff() < 1e6)) continue;
      Cell& cell = cells_[key_of(at)];
      if (cell.frames == 0) cell.first_rad = angle_rad;
      if (cell.last != number) ++cell.frames, cell.last = number;
      cell.around_rad =
          std::max(cell.around_rad, std::abs(std::remainder(angle_rad - cell.first_rad, kTurn)));
      if (inner) cell.low_m = std::min(cell.low_m, frame_.height(p));
      cell.heights_m += frame_.height(p);
      cell.points += 1.0;
      cell.reach_m = std::max(cell.reach_m, frame_.radius(p));
    }
  }

  /// nullopt if no cell was seen often enough.
  std::optional<Extent> extent() const {
    std::optional<Extent> out;
    for (const auto& [key, cell] : cells_) {
      if (cell.frames < kMinSupport || cell.around_rad < kMinAround_rad) continue;
      if (!out) out = Extent{cell.low_m, cell.reach_m};
      out->low_m = std::min(out->low_m, cell.low_m);
      out->reach_m = std::max(out->reach_m, cell.reach_m);
    }
    if (out && out->low_m == kNothing_m) return std::nullopt;
    return out;
  }

  /// Number of frames that saw the cell of a point, averaged over all points.
  double mean_support() const {
    double sum = 0.0, points = 0.0;
    for (const auto& [key, cell] : cells_) sum += cell.points * cell.frames, points += cell.points;
    return points > 0.0 ? sum / points : 0.0;
  }

  /// Mean height of the lowest cell that many frames saw, if it is well below low_m; else low_m.
  double thin_low(double low_m) const {
    const auto least = std::max(kMinSupport, std::uint32_t(kThinShare * double(frames_)));
    const double highest = low_m - kThinCells * cell_m_;
    double lowest = highest;
    for (const auto& [key, cell] : cells_) {
      if (cell.frames < least || cell.around_rad < kMinAround_rad) continue;
      lowest = std::min(lowest, cell.heights_m / cell.points);
    }
    return lowest < highest ? lowest : low_m;
  }

 private:
  struct Cell {
    std::uint32_t frames = 0, last = 0;
    double first_rad = 0.0, around_rad = 0.0;
    double low_m = kNothing_m, reach_m = 0.0;
    double heights_m = 0.0, points = 0.0;
  };

  static std::uint64_t key_of(const Vec3d& at) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k)
      key = key << 21 | std::uint64_t(std::int64_t(std::floor(at[k])) + (1 << 20));
    return key;
  }

  AxisFrame frame_;
  double cell_m_;
  std::uint32_t frames_ = 0;
  std::unordered_map<std::uint64_t, Cell> cells_;
};

/// Depths of static pixels, as medians over some frames; 0 elsewhere.
class StillImage {
 public:
  static Result<StillImage> read(const MotionData& data, const FrameSequence& sequence) {
    const SensorInfo& sensor = sequence.header().sensors.front();
    StillImage out;
    out.width_ = sensor.intrinsics.width, out.height_ = sensor.intrinsics.height;
    const std::size_t pixels = std::size_t(out.width_) * std::size_t(out.height_);
    std::vector<std::vector<std::uint16_t>> images;
    for (const std::size_t i : evenly_spread(data.frames.size(), kFrames)) {
      TURNSCAN_ASSIGN(Frame frame, sequence.read(data.frames[i].position));
      if (frame.depth.pixels.size() == pixels) images.push_back(std::move(frame.depth.pixels));
    }
    out.depth_.assign(pixels, 0.0f);
    const double most = kStillSigmas * data.noise_m;
    parallel_for(pixels, 4096,
                 [&](std::size_t i) { out.depth_[i] = still(images, i, sensor, most); });
    return out;
  }

  int width() const { return width_; }
  int height() const { return height_; }
  double at(int x, int y) const {
    return depth_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  }

  /// Whether the pixel or an adjacent one shows something static at about this depth.
  bool touches(int x, int y, double z, double limit_m) const {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height_ - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width_ - 1); ++u)
        if (std::abs(at(u, v) - z) < limit_m) return true;
    return false;
  }

  /// Whether the static pixel shows a surface rather than a mixture of two.
  bool on_surface(int x, int y, double limit_m) const {
    int near = 0;
    for (const auto& [dx, dy] : {std::pair{0, -1}, {-1, 0}, {1, 0}, {0, 1}}) {
      const double there = at(x + dx, y + dy);
      if (!(there > 0.0)) continue;
      if (std::abs(there - at(x, y)) > limit_m) return false;
      ++near;
    }
    return near >= 2;
  }

 private:
  static float still(const std::vector<std::vector<std::uint16_t>>& images, std::size_t i,
                     const SensorInfo& sensor, double most_m) {
    std::array<std::uint16_t, kFrames> values;
    std::size_t n = 0;
    for (const auto& image : images)
      if (image[i] != kNoReturn && image[i] != kOutsideCrop) values[n++] = image[i];
    if (n < 3 || double(n) < kMinSeen * double(images.size())) return 0.0f;
    std::sort(values.begin(), values.begin() + std::ptrdiff_t(n));
    const double spread = values[n - 1 - n / 10] - values[n / 10];
    if (spread * sensor.depth_unit_m > most_m) return 0.0f;
    return float(values[n / 2] * sensor.depth_unit_m + sensor.depth_bias_m);
  }

  int width_ = 0, height_ = 0;
  std::vector<float> depth_;
};

/// How many of the four neighbours of a pixel that is not at the border have about the same depth.
template <class DepthAt>
int same_beside(const DepthAt& depth_at, int x, int y, double limit_m) {
  int same = 0;
  for (const auto& [dx, dy] : {std::pair{0, -1}, {-1, 0}, {1, 0}, {0, 1}})
    if (std::abs(depth_at(x + dx, y + dy) - depth_at(x, y)) < limit_m) ++same;
  return same;
}

/// Whether at least three of the four neighbours of a pixel that is not at the border show the same
/// surface. A mixed rim of a static surface is one pixel wide.
bool is_inner(const FrameSurface& surface, int x, int y, double limit_m) {
  if (x < 1 || y < 1 || x + 1 >= surface.width || y + 1 >= surface.height) return false;
  const auto at = [&](int u, int v) {
    return double(surface.z[std::size_t(v) * std::size_t(surface.width) + std::size_t(u)]);
  };
  return same_beside(at, x, y, limit_m) >= 3;
}

/// The turning part as a frame saw it, without flicker at the rims of static surfaces: a round foot
/// turns about itself, too.
std::vector<TurningPoint> turning_points(const MotionData& data, const MotionFrame& frame,
                                         const RayTable& rays, const StillImage& image) {
  std::vector<TurningPoint> out;
  if (!data.projective) {
    const std::size_t step = 1 + frame.surface.points.size() / kMaxPoints;
    for (std::size_t i = 0; i < frame.surface.points.size(); i += step)
      out.push_back({frame.surface.points[i].cast<double>(), true});
    return out;
  }
  const FrameSurface& surface = frame.raw_surface;
  for (int y = 0; y < surface.height; ++y) {
    for (int x = 0; x < surface.width; ++x) {
      const double z = surface.z[std::size_t(y) * std::size_t(surface.width) + std::size_t(x)];
      const double pixel = z / data.camera.fx;
      const int u = surface.left + x, v = surface.top + y;
      if (!(z > 0.0) || image.touches(u, v, z, 1.5 * pixel + 3.0 * data.noise_m)) continue;
      const std::size_t i = std::size_t(v) * std::size_t(data.camera.width) + std::size_t(u);
      out.push_back({{rays.x()[i] * z, rays.y()[i] * z, z},
                     is_inner(surface, x, y, 3.0 * pixel + 3.0 * data.noise_m)});
    }
  }
  return out;
}

/// Depths of a frame, as DepthAt of same_beside.
struct FrameDepths {
  const DepthImage& depth;
  const SensorInfo& sensor;

  double operator()(int x, int y) const {
    const std::uint16_t value =
        depth.pixels[std::size_t(y) * std::size_t(depth.width) + std::size_t(x)];
    return value == kNoReturn || value == kOutsideCrop
               ? 0.0
               : value * sensor.depth_unit_m + sensor.depth_bias_m;
  }
};

/// What a frame saw below the turning part, within its reach. Of mixed pixels, at random depths,
/// few have two neighbours at the same depth.
std::vector<TurningPoint> points_below(const MotionData& data, const DepthImage& depth,
                                       const SensorInfo& sensor, const RayTable& rays,
                                       const AxisFrame& frame, const Extent& turning) {
  const int w = data.camera.width;
  const FrameDepths at{depth, sensor};
  std::vector<TurningPoint> out;
  for (int y = 1; y + 1 < data.camera.height; ++y) {
    for (int x = 1; x + 1 < w; ++x) {
      const double z = at(x, y), pixel = z / data.camera.fx;
      if (!(z > 0.0)) continue;
      const auto i = std::size_t(y) * std::size_t(w) + std::size_t(x);
      const Vec3d p(rays.x()[i] * z, rays.y()[i] * z, z);
      if (frame.height(p) > turning.low_m || frame.radius(p) > turning.reach_m) continue;
      if (same_beside(at, x, y, 1.5 * pixel + 3.0 * data.noise_m) < 2) continue;
      out.push_back({p, false});
    }
  }
  return out;
}

/// Static pixels in slices below a height, within reach of the axis.
class StillSlices {
 public:
  StillSlices(const AxisFrame& frame, const Extent& turning) : frame_(frame), turning_(turning) {}

  void add(const StillImage& image, const CameraIntrinsics& camera, const RayTable& rays,
           double noise_m) {
    for (int y = 1; y + 1 < image.height(); ++y) {
      for (int x = 1; x + 1 < image.width(); ++x) {
        const double z = image.at(x, y);
        if (!(z > 0.0)) continue;
        const auto i = std::size_t(y) * std::size_t(image.width()) + std::size_t(x);
        const Vec3d p(rays.x()[i] * z, rays.y()[i] * z, z);
        const double height = frame_.height(p), radius = frame_.radius(p);
        const double below = (turning_.low_m + kAbove_m - height) / kSlice_m;
        if (below < 0.0 || below >= double(kSlices) || radius > turning_.reach_m) continue;
        if (image.on_surface(x, y, 3.0 * z / camera.fx + 3.0 * noise_m))
          slices_[std::size_t(below)].add(height, radius);
      }
    }
  }

  double pixels() const {
    double sum = 0.0;
    for (const Slice& slice : slices_) sum += slice.pixels;
    return sum;
  }

  /// spacing_m: between pixels. up: cosine of the angle between the axis and the direction to the
  /// sensor.
  ObjectBase base(double spacing_m, double up) const {
    const double pixel = spacing_m * spacing_m, across = std::sqrt(1.0 - up * up);
    const double column = kSlice_m * std::max(across, 0.1) / pixel;  // pixels per metre of width
    const double least = std::max(1.5, kMinWidth_m * column);
    const double gap = std::max(kMinGap_m, kGapRows * spacing_m / std::max(across, 0.3));
    const double top = turning_.low_m + kAbove_m;
    double end = kAbove_m, empty = 0.0;
    for (std::size_t k = 0; k + kSpreadSlices <= kSlices; ++k) {
      Slice window;
      for (std::size_t j = k; j < k + kSpreadSlices; ++j) window.add(slices_[j]);
      // For a disc as wide as the surface at this height, and for an upright column as wide.
      const double wide = window.wide_m();
      const double disc = std::numbers::pi * wide * wide * up / pixel;
      if (wide > kMinDesk_m &&
          window.pixels > std::max(kSpreadShare * disc,
                                   kSpreadColumns * 2.0 * wide * column * double(kSpreadSlices)))
        return {surface_at(k), turning_.low_m - surface_at(k) < kTouches_m, true, turning_.reach_m};
      if (double(k) * kSlice_m < kAbove_m) continue;
      empty = slices_[k].pixels < least ? empty + kSlice_m : 0.0;
      if (empty >= gap) break;
      if (empty == 0.0) end = double(k + 1) * kSlice_m;
    }
    return {top - end, true, false, turning_.reach_m};
  }

 private:
  struct Slice {
    double pixels = 0.0, heights_m = 0.0, squared_radii_m2 = 0.0;

    void add(double height_m, double radius_m) { add({1.0, height_m, radius_m * radius_m}); }
    void add(const Slice& other) {
      pixels += other.pixels;
      heights_m += other.heights_m;
      squared_radii_m2 += other.squared_radii_m2;
    }
    /// Radius of the disc that has as many pixels.
    double wide_m() const {
      return pixels > 0.0 ? std::sqrt(2.0 * squared_radii_m2 / pixels) : 0.0;
    }
  };

  /// Mean height of the surface whose first pixels are in slice k.
  double surface_at(std::size_t k) const {
    std::size_t most = k;
    for (std::size_t j = k; j < std::min(k + 2 * kSpreadSlices, kSlices); ++j)
      if (slices_[j].pixels > slices_[most].pixels) most = j;
    Slice about;
    for (std::size_t j = most > 0 ? most - 1 : 0; j < std::min(most + 2, kSlices); ++j)
      about.add(slices_[j]);
    return about.heights_m / about.pixels;
  }

  AxisFrame frame_;
  Extent turning_;
  std::vector<Slice> slices_ = std::vector<Slice>(kSlices);
};

/// Follows the surface within kFoot_m above a first estimate of the base down each image column, to
/// where it ends at a step in depth or without return. Turning points and slices leave out the last
/// rows of pixels, which are mixtures and flicker.
class ColumnEnds {
 public:
  ColumnEnds(const AxisFrame& frame, const ObjectBase& first) : frame_(frame), first_(first) {}

  void add(const MotionData& data, const FrameDepths& at, const RayTable& rays) {
    const auto point = [&](int x, int y) {
      const auto i = std::size_t(y) * std::size_t(data.camera.width) + std::size_t(x);
      return Vec3d(Vec3d(rays.x()[i], rays.y()[i], 1.0) * at(x, y));
    };
    const auto within = [&](int x, int y, double low_m, double high_m) {
      if (!(at(x, y) > 0.0)) return false;
      const Vec3d p = point(x, y);
      const double above = frame_.height(p) - first_.height_m;
      return above > low_m && above < high_m && frame_.radius(p) < first_.reach_m.value_or(0.0);
    };
    for (int x = 0; x < data.camera.width; ++x) {
      int y = data.camera.height - 1, below = 0;
      for (; y >= 0 && !within(x, y, 0.0, kFoot_m); --y)
        below += within(x, y, -kBelow_m, -kFoot_m) ? 1 : 0;
      if (y < 0) continue;
      Vec3d p = point(x, y);
      for (; ++y < data.camera.height && at(x, y) > 0.0; p = point(x, y))
        if ((point(x, y) - p).norm() > 2.0 * data.spacing_m + 3.0 * data.noise_m) break;
      heights_m_.push_back(frame_.height(p));
      below_ += below >= kMinBelow ? 1.0 : 0.0;
    }
  }

  /// Whether something stands still below the object, on which columns may continue.
  bool seen_below() const { return below_ > kLowestEnds * double(heights_m_.size()); }

  /// If nothing is below, the lowest end but for noise, else the median; nullopt if hardly a column
  /// ends.
  std::optional<double> height() {
    if (heights_m_.size() < kMinEnds) return std::nullopt;
    const double share = seen_below() ? 0.5 : kLowestEnds;
    const auto at = heights_m_.begin() + std::ptrdiff_t(share * double(heights_m_.size()));
    std::nth_element(heights_m_.begin(), at, heights_m_.end());
    return *at;
  }

 private:
  AxisFrame frame_;
  ObjectBase first_;
  std::vector<double> heights_m_;
  double below_ = 0.0;  ///< columns that show something below
};

/// The base where the surface that turns and is not on anything was seen to end.
Result<ObjectBase> followed_down(ObjectBase base, const MotionData& data,
                                 const FrameSequence& sequence, const RayTable& rays,
                                 const AxisFrame& frame) {
  if (base.on_surface || !base.ends) return base;
  const SensorInfo& sensor = sequence.header().sensors.front();
  std::vector<Frame> frames;
  for (const std::size_t i : evenly_spread(data.frames.size(), kFrames)) {
    TURNSCAN_ASSIGN(Frame seen, sequence.read(data.frames[i].position));
    if (seen.depth.pixels.size() == rays.x().size()) frames.push_back(std::move(seen));
  }
  for (bool lower = true; lower;) {
    ColumnEnds ends(frame, base);
    for (const Frame& seen : frames) ends.add(data, FrameDepths{seen.depth, sensor}, rays);
    const double height = ends.height().value_or(base.height_m);
    lower = !ends.seen_below() && height < base.height_m - kSettled_m;
    base.height_m = height;
  }
  return base;
}

/// Used if hardly any turning point was seen: the height below which a two-hundredth of the points
/// is.
double low_of_cloud(const MotionData& data, const AxisFrame& frame) {
  std::vector<double> heights;
  for (const Vec3f& p : data.cloud) heights.push_back(frame.height(p.cast<double>()));
  const auto at = heights.begin() + std::ptrdiff_t(0.005 * double(heights.size() - 1));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

/// Lowest height of the turning part if nothing static is below it.
Result<double> low_of_thin_parts(const MotionData& data, std::span<const double> angles_rad,
                                 const FrameSequence& sequence, const RayTable& rays,
                                 const AxisFrame& frame, const Extent& turning, double cell_m) {
  TurningCells turned(frame, cell_m), still(frame, cell_m);
  const SensorInfo& sensor = sequence.header().sensors.front();
  for (const std::size_t i : evenly_spread_to_last(data.keys, kTurningFrames)) {
    TURNSCAN_ASSIGN(const Frame seen, sequence.read(data.frames[i].position));
    if (seen.depth.pixels.size() != rays.x().size()) continue;
    const auto points = points_below(data, seen.depth, sensor, rays, frame, turning);
    turned.add(points, angles_rad[i], std::uint32_t(i + 1));
    still.add(points, 0.0, std::uint32_t(i + 1));
  }
  if (turned.mean_support() < kTurnsRather * still.mean_support()) return turning.low_m;
  return turned.thin_low(turning.low_m);
}

}  // namespace

Result<ObjectBase> find_base(const MotionData& data, const TurntableInfo& axis,
                             std::span<const double> angles_rad, const FrameSequence& sequence) {
  const AxisFrame frame{axis.axis, axis.center_m};
  StillImage image;
  if (data.projective) {
    TURNSCAN_ASSIGN(image, StillImage::read(data, sequence));
  }
  const double cell_m = std::max(kMinCell_m, kCellSpacings * data.spacing_m);
  TurningCells cells(frame, cell_m);
  const RayTable rays(data.camera);
  for (const std::size_t i : evenly_spread_to_last(data.keys, kTurningFrames))
    cells.add(turning_points(data, data.frames[i], rays, image), angles_rad[i],
              std::uint32_t(i + 1));
  const auto turning = cells.extent();
  if (!turning) return ObjectBase{low_of_cloud(data, frame), false, false, std::nullopt};
  if (!data.projective) return ObjectBase{turning->low_m, true, false, turning->reach_m};
  StillSlices slices(frame, *turning);
  slices.add(image, data.camera, rays, data.noise_m);
  ObjectBase base =
      slices.base(data.spacing_m, std::clamp(axis.axis.dot(data.to_sensor), 0.0, 1.0));
  if (slices.pixels() < kMinStill) {
    TURNSCAN_ASSIGN(const double low_m,
                    low_of_thin_parts(data, angles_rad, sequence, rays, frame, *turning, cell_m));
    if (low_m < turning->low_m) base = {low_m, true, false, turning->reach_m};
  }
  return followed_down(base, data, sequence, rays, frame);
}

}  // namespace turnscan::motion
