// Detection of the platter on random turntables with known truth: its errors, and its errors over
// the deviations that it states. Usage: detect_tables [FIRST SEED] [TABLES] [FRAMES]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace {

using namespace turnscan;

struct TableRecipe {
  std::uint64_t seed = 0;
  std::string object;  ///< empty: the platter alone
  VirtualScanOptions options;
};

/// The recipe is fixed: other numbers would make the figures of two versions incomparable.
TableRecipe random_table(std::uint64_t seed, int frames) {
  const auto unit = [&](std::uint64_t k) { return uniform01(hash_key(seed, 0x7461626cULL, k)); };
  const auto between = [&](std::uint64_t k, double low, double high) {
    return low + (high - low) * unit(k);
  };
  TableRecipe out;
  out.seed = seed;
  if (unit(0) < 0.5)
    out.object = std::array{"cylinder", "doll", "letter-a"}[std::size_t(3.0 * unit(1))];
  VirtualScanOptions& o = out.options;
  VirtualScanner scanner;
  scanner.placement.distance_m = between(2, 0.5, 1.5);
  scanner.placement.elevation_rad = between(3, 5.0, 45.0) * kRadiansPerDegree;
  scanner.placement.aim_height_m = between(4, 0.0, 0.08);
  o.scanners.push_back(scanner);
  o.platter.radius_m = between(5, 0.100, 0.250);
  o.platter.thickness_m = unit(6) < 0.2 ? 0.0 : between(7, 0.0, 0.030);
  o.table.x_m = between(8, -0.008, 0.008);
  o.table.y_m = between(9, -0.008, 0.008);
  o.table.z_m = between(10, -0.008, 0.008);
  o.table.tilt_rad = between(11, 0.0, 3.0) * kRadiansPerDegree;
  o.table.tilt_direction_rad = between(12, 0.0, kTurn);
  o.room.kind = static_cast<RoomKind>(static_cast<int>(4.0 * unit(13)));
  o.measure.noise = unit(14) < 0.5 ? "gaussian:1.5mm" : "physics";
  if (o.measure.noise != "physics" && unit(15) < 0.75) o.measure.mixed_pixels = unit(16);
  o.measure.seed = static_cast<int>(seed);
  o.motion.frames = frames;
  return out;
}

Result<AveragedScan> scan_of(const TableRecipe& table, int frames) {
  VirtualScanOptions options = table.options;
  TURNSCAN_ASSIGN(options.scanners[0].model, find_scanner("kinect-v2"));
  std::vector<TriangleMesh> objects;
  if (!table.object.empty()) {
    TURNSCAN_ASSIGN(TriangleMesh mesh, builtin_object(table.object));
    objects.push_back(std::move(mesh));
  }
  TURNSCAN_ASSIGN(const VirtualScan scan, VirtualScan::create(std::move(objects), options));
  AverageOptions average;
  average.frames = frames;
  return average_frames(scan, spread_positions(scan, 0, std::size_t(frames)), average, {});
}

/// Sensor frame.
TurntableInfo truth_of(const TableRecipe& table) {
  const Pose T_world_table = table_pose(table.options.table);
  const Pose T_world_sensor =
      scanner_pose(table.options.scanners[0].placement, 0.0, 0.5, T_world_table.linear().col(1));
  const Pose T_sensor_table = T_world_sensor.inverse() * T_world_table;
  TurntableInfo truth;
  truth.axis = T_sensor_table.linear().col(1);
  truth.center_m = T_sensor_table.translation();
  truth.radius_m = table.options.platter.radius_m;
  return truth;
}

/// An error and what was stated for it.
struct Judged {
  double error = 0.0, sigma = 0.0;
  double ratio() const { return error / sigma; }
};

struct Outcome {
  bool found = false;
  Judged axis_deg, center_mm, height_mm, radius_mm;
  double seconds = 0.0;
};

Outcome judge(const DetectedPlatter& p, const TurntableInfo& truth) {
  const Vec3d offset = p.center_m - truth.center_m;
  const double height = offset.dot(truth.axis);
  Outcome out;
  out.found = true;
  out.axis_deg = {
      std::atan2(p.axis.cross(truth.axis).norm(), p.axis.dot(truth.axis)) * kDegreesPerRadian,
      p.axis_sigma_rad * kDegreesPerRadian};
  out.center_mm = {(offset - height * truth.axis).norm() * 1e3, p.center_sigma_m * 1e3};
  out.height_mm = {height * 1e3, p.height_sigma_m * 1e3};
  out.radius_mm = {(p.radius_m - *truth.radius_m) * 1e3, p.radius_sigma_m * 1e3};
  return out;
}

void print_recipe(const TableRecipe& table) {
  const VirtualScanOptions& o = table.options;
  constexpr std::array kRooms{"none", "desk", "wall", "clutter"};
  fmt::print(
      "{:4} {:8} mix {:4.2f} {:4.2f} m {:4.1f} deg r {:3.0f} t {:4.1f} {:7} {:8}: ", table.seed,
      o.measure.noise.substr(0, 8), o.measure.mixed_pixels, o.scanners[0].placement.distance_m,
      o.scanners[0].placement.elevation_rad * kDegreesPerRadian, o.platter.radius_m * 1e3,
      o.platter.thickness_m * 1e3, kRooms[std::size_t(o.room.kind)],
      table.object.empty() ? "-" : table.object);
}

void print_outcome(const Outcome& o, const DetectedPlatter& p) {
  const auto figure = [](const char* name, const Judged& j, int digits) {
    fmt::print("{} {:.{}f} +-{:.{}f} ({:.1f}) ", name, j.error, digits, j.sigma, digits, j.ratio());
  };
  figure("axis", o.axis_deg, 3);
  figure("centre", o.center_mm, 2);
  figure("height", o.height_mm, 2);
  figure("radius", o.radius_mm, 2);
  fmt::print("rim {:.2f} confidence {:.2f} {:.2f} s\n", p.rim_share, p.confidence, o.seconds);
}

Outcome try_table(const TableRecipe& table, const Result<AveragedScan>& scan) {
  print_recipe(table);
  const auto start = std::chrono::steady_clock::now();
  const auto platter = scan ? detect_platter(*scan, {}, {}) : tl::unexpected<Error>(scan.error());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!platter) {
    fmt::print("refused: {}\n", platter.error().text());
    return {};
  }
  Outcome out = judge(*platter, truth_of(table));
  out.seconds = seconds;
  print_outcome(out, *platter);
  return out;
}

double rms_ratio(const std::vector<Outcome>& outcomes, Judged Outcome::*what) {
  double squares = 0.0;
  for (const Outcome& o : outcomes) squares += (o.*what).ratio() * (o.*what).ratio();
  return std::sqrt(squares / double(std::max<std::size_t>(1, outcomes.size())));
}

double median_error(std::vector<Outcome> outcomes, Judged Outcome::*what) {
  if (outcomes.empty()) return std::nan("");
  const auto middle = outcomes.begin() + std::ptrdiff_t(outcomes.size() / 2);
  std::nth_element(outcomes.begin(), middle, outcomes.end(), [&](const Outcome& l, const auto& r) {
    return std::abs((l.*what).error) < std::abs((r.*what).error);
  });
  return std::abs(((*middle).*what).error);
}

void summarise(const std::vector<Outcome>& all) {
  std::vector<Outcome> found;
  std::size_t good = 0, wrong = 0;
  double slowest = 0.0;
  for (const Outcome& o : all) {
    if (!o.found) continue;
    found.push_back(o);
    good += o.center_mm.error < 1.0 || o.center_mm.ratio() < 2.0 ? 1 : 0;
    wrong += o.center_mm.error > 5.0 && o.center_mm.ratio() > 3.0 ? 1 : 0;
    slowest = std::max(slowest, o.seconds);
  }
  fmt::print(
      "{} tables: {} found, {} of them with a centre within 1 mm or 2 deviations, {} "
      "silently wrong, {} refused; at most {:.2f} s\n",
      all.size(), found.size(), good, wrong, all.size() - found.size(), slowest);
  const auto line = [&](const char* name, Judged Outcome::*what) {
    fmt::print("  {:12} median error {:.3f}, errors over deviations rms {:.2f}\n", name,
               median_error(found, what), rms_ratio(found, what));
  };
  line("axis (deg)", &Outcome::axis_deg);
  line("centre (mm)", &Outcome::center_mm);
  line("height (mm)", &Outcome::height_mm);
  line("radius (mm)", &Outcome::radius_mm);
}

}  // namespace

int main(int argc, char** argv) {
  const int first = argc > 1 ? std::stoi(argv[1]) : 1;
  const int tables = argc > 2 ? std::stoi(argv[2]) : 50;
  const int frames = argc > 3 ? std::stoi(argv[3]) : 24;
  std::vector<Outcome> outcomes;
  for (int seed = first; seed < first + tables; ++seed) {
    const TableRecipe table = random_table(std::uint64_t(seed), frames);
    outcomes.push_back(try_table(table, scan_of(table, frames)));
  }
  summarise(outcomes);
}
