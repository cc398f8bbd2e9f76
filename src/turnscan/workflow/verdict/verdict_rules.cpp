#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/finishing/hole_patches.hpp>
#include <turnscan/reconstruction/quality/thin_walls.hpp>
#include <turnscan/workflow/verdict/error_shares.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

namespace turnscan {

namespace {

constexpr double kTolerance_m = 0.001;
constexpr double kGoodShare = 0.97, kFairShare = 0.85;  // of what was seen, within the tolerance
/// Of the surface. What too few frames saw counts as invented, too: 4 % on average, by which these
/// lie above what is wanted of what no frame saw (0.10 and 0.25).
constexpr double kGoodInvented = 0.14, kFairInvented = 0.29;
constexpr double kWholeTurn = 0.95, kHalfTurn = 0.5;
constexpr double kFewFrames = 6.0;
constexpr double kNozzle_m = 0.0008;
constexpr double kFewDropped = 0.02, kManyDropped = 0.2;
constexpr std::size_t kThicknessSamples = 4000, kNamedHoles = 3;

Level level_of(double value, double good, double fair) {
  return value >= good ? Level::kGood : value >= fair ? Level::kFair : Level::kBad;
}

/// How far the poses of the frames may be off, as a shift of what they saw.
struct PoseError {
  double shift_m = 0.0;   ///< across the axis
  double tilt_rad = 0.0;  ///< of the axis
};

PoseError pose_error(const CalibrationChoice* choice) {
  PoseError out;
  if (choice == nullptr) return out;
  if (choice->calibration) {
    const Calibration& found = *choice->calibration;
    if (std::isfinite(found.center_sigma_m)) out.shift_m = found.center_sigma_m;
    if (std::isfinite(found.axis_sigma_rad)) out.tilt_rad = found.axis_sigma_rad;
  } else if (const auto& offset = choice->checks.axis_offset) {
    // What is found beside the recorded axis may be either's error.
    out.shift_m = std::max(offset->shift_sigma_m, 0.5 * offset->shift_m);
    out.tilt_rad = std::max(offset->tilt_sigma_rad, 0.5 * offset->tilt_rad);
  }
  if (const auto& closure = choice->checks.closure)
    out.shift_m = std::max(out.shift_m,
                           0.5 * std::sqrt(std::max(0.0, closure->shift_m * closure->shift_m -
                                                             closure->noise_m * closure->noise_m)));
  return out;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> out(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double third = triangle_area(mesh, t) / 3.0;
    for (const std::uint32_t v : mesh.triangles[t]) out[v] += third;
  }
  return out;
}

/// The smallest value that so much of the weight does not exceed.
int weighted_quantile(std::vector<std::pair<int, double>> values, double share) {
  std::sort(values.begin(), values.end());
  double all = 0.0, sum = 0.0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (sum >= share * all) return value;
  }
  return values.empty() ? 0 : values.back().first;
}

class Judge {
 public:
  Judge(ObjectResult& object, const Reconstruction& run, const ScanKnowledge& known)
      : object_(object),
        run_(run),
        known_(known),
        normals_(vertex_normals(object.mesh)),
        areas_(vertex_areas(object.mesh)),
        measured_(measured_vertices(object)) {}

  Verdict run() {
    add_pose_errors();
    say_turn();
    say_seen();
    say_error();
    say_invented();
    say_agreement();
    say_disturbances();
    say_frames();
    say_thin();
    say_mesh();
    say_help();
    return std::move(out_);
  }

 private:
  void say(std::string topic, Level level, std::string text, double value = std::nan(""),
           std::string unit = "") {
    out_.sentences.push_back({std::move(topic), level, std::move(text), value, std::move(unit)});
  }

  /// A shift of the frames moves what faces that way; a tilt moves it by its distance from the
  /// middle.
  void add_pose_errors() {
    if (object_.quality.empty()) return;
    const PoseError error = pose_error(known_.choice);
    const Vec3d middle = bounds(object_.mesh.vertices).center();
    for (std::size_t v = 0; v < object_.quality.size(); ++v) {
      const Vec3d n = normals_[v].cast<double>();
      const double across = std::hypot(n.x(), n.z());
      const double lever = (object_.mesh.vertices[v].cast<double>() - middle).norm();
      float& expected = object_.quality[v].expected_error_m;
      expected = float(std::sqrt(double(expected) * double(expected) +
                                 std::pow(error.shift_m * across, 2) +
                                 std::pow(error.tilt_rad * lever, 2)));
    }
  }

  void say_turn() {
    if (!known_.turn) return;
    const TurnSeen& turn = *known_.turn;
    const double missing = 360.0 * (1.0 - turn.share);
    const Level level = level_of(turn.share, kWholeTurn, kHalfTurn);
    say("turn", level,
        level == Level::kGood
            ? fmt::format("the frames look from all sides, over {:.2f} turns", turn.turns)
            : fmt::format(
                  "the frames look from {:.0f} of 360 degrees; of the other {:.0f} there is "
                  "no view",
                  360.0 - missing, missing),
        turn.share * 360.0, "deg");
  }

  void say_seen() {
    if (object_.quality.empty()) return;
    std::vector<std::pair<int, double>> frames, directions;
    for (std::size_t v = 0; v < areas_.size(); ++v) {
      if (!measured_[v]) continue;
      frames.emplace_back(object_.quality[v].frames, areas_[v]);
      directions.emplace_back(object_.quality[v].directions, areas_[v]);
    }
    const int usual = weighted_quantile(frames, 0.5), least = weighted_quantile(frames, 0.05);
    say("seen", usual >= kFewFrames ? Level::kGood : Level::kFair,
        fmt::format("half of what was measured was seen by {} frames or more, from {} or more "
                    "directions (30 degrees each); 5 % of it by {} or fewer",
                    usual, weighted_quantile(directions, 0.5), least),
        usual, "frames");
  }

  void say_error() {
    if (object_.quality.empty()) {
      say("error", Level::kFair,
          "how far it lies from the truth is only estimated with --method volumetric");
      return;
    }
    const ErrorShares errors = error_shares();
    const double share = errors.within(kTolerance_m), median_m = errors.error_of(0.5);
    say("error", level_of(share, kGoodShare, kFairShare),
        fmt::format("what was measured is expected {:.2f} mm from the truth (median; 95 % within "
                    "{:.2f} mm), {:.1f} % of it within 1 mm",
                    median_m * 1e3, errors.error_of(0.95) * 1e3, 100.0 * share),
        median_m * 1e3, "mm");
  }

  ErrorShares error_shares() const {
    ErrorShares out;
    for (std::size_t v = 0; v < areas_.size(); ++v)
      if (measured_[v]) out.add(object_.quality[v].expected_error_m, areas_[v]);
    return out;
  }

  static std::string place_of(const TriangleMesh& mesh, const finishing::HolePatch& hole) {
    Vec3d middle = Vec3d::Zero(), normal = Vec3d::Zero();
    for (const std::uint32_t t : hole.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3d p = mesh.vertices[a].cast<double>(), q = mesh.vertices[b].cast<double>(),
                  r = mesh.vertices[c].cast<double>();
      const Vec3d twice = (q - p).cross(r - p);
      middle += twice.norm() * (p + q + r) / 3.0;
      normal += twice;
    }
    middle /= 2.0 * hole.area_m2;
    const double up = normal.y() / std::max(normal.norm(), 1e-12);
    const double heading = std::atan2(-middle.z(), middle.x()) * kDegreesPerRadian;
    const std::string side = up < -0.6  ? "underneath"
                             : up > 0.6 ? "on top"
                                        : fmt::format("on the side at {:.0f} deg",
                                                      heading < 0.0 ? heading + 360.0 : heading);
    return fmt::format("{:.1f} cm2 {}, {:.0f} mm high", hole.area_m2 * 1e4, side, middle.y() * 1e3);
  }

  void say_invented() {
    if (object_.evidence.empty()) return;
    double base_m2 = 0.0;
    std::vector<Evidence> hidden = object_.evidence;
    for (std::size_t t = 0; t < hidden.size(); ++t) {
      if (hidden[t] == Evidence::kInvented) continue;
      if (hidden[t] == Evidence::kBase) base_m2 += triangle_area(object_.mesh, t);
      hidden[t] = Evidence::kMeasured;
    }
    const double area_m2 = surface_area(object_.mesh);
    invented_ = area_m2 > 0.0 ? object_.invented_area_m2 / area_m2 : 0.0;
    auto holes = finishing::find_hole_patches(object_.mesh, hidden);
    std::sort(holes.begin(), holes.end(),
              [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
    std::string largest;
    for (std::size_t i = 0; i < std::min(holes.size(), kNamedHoles); ++i)
      if (holes[i].area_m2 > 1e-4)
        largest += fmt::format("{}{}", largest.empty() ? "; the largest: " : ", ",
                               place_of(object_.mesh, holes[i]));
    say("invented", level_of(1.0 - invented_, 1.0 - kGoodInvented, 1.0 - kFairInvented),
        fmt::format("{:.1f} cm2 ({:.0f} %) of the surface no frame saw{}{}",
                    object_.invented_area_m2 * 1e4, 100.0 * invented_,
                    base_m2 > 0.0 ? fmt::format(", and {:.1f} cm2 ({:.0f} %) of base stood on the "
                                                "platter",
                                                base_m2 * 1e4, 100.0 * base_m2 / area_m2)
                                  : "",
                    largest),
        100.0 * invented_, "%");
  }

  void say_agreement() {
    const CalibrationChoice* choice = known_.choice;
    if (choice == nullptr) return;
    if (choice->calibration) {
      const Calibration& found = *choice->calibration;
      const bool open = !found.undetermined.empty();
      say("calibration", open ? Level::kFair : Level::kGood,
          fmt::format(
              "the turntable was found from motion, its axis to {:.2f} deg and {:.2f} mm{}",
              found.axis_sigma_rad * kDegreesPerRadian, found.center_sigma_m * 1e3,
              open ? fmt::format("; not determined: {}", fmt::join(found.undetermined, ", ")) : ""),
          found.center_sigma_m * 1e3, "mm");
    } else if (const auto& offset = choice->checks.axis_offset) {
      say("calibration", offset->bad() ? Level::kBad : Level::kGood,
          fmt::format("the frames turn about an axis {:.2f} mm and {:.2f} deg from the recorded "
                      "one (known to {:.2f} mm and {:.2f} deg)",
                      offset->shift_m * 1e3, offset->tilt_rad * kDegreesPerRadian,
                      offset->shift_sigma_m * 1e3, offset->tilt_sigma_rad * kDegreesPerRadian),
          offset->shift_m * 1e3, "mm");
    }
    if (const auto& closure = choice->checks.closure; closure && !choice->calibration)
      say("closure", closure->bad() ? Level::kBad : Level::kGood,
          fmt::format("one turn later the object lies {:.2f} mm from where it was, noise alone "
                      "makes {:.2f} mm",
                      closure->shift_m * 1e3, closure->noise_m * 1e3),
          closure->shift_m * 1e3, "mm");
  }

  void say_disturbances() {
    if (known_.choice == nullptr) return;
    const CalibrationChoice& choice = *known_.choice;
    const bool corrected = !choice.poses.empty() || !choice.left_out.empty();
    for (const Disturbance& disturbance : choice.disturbances)
      say("disturbance", corrected ? Level::kGood : Level::kBad,
          fmt::format(
              "{}; {}", disturbance.text,
              corrected ? "its frames were put right or left out" : "nothing was done about it"),
          disturbance.size_m * 1e3, "mm");
  }

  void say_frames() {
    const std::size_t all = run_.frames + run_.dropped_frames;
    if (run_.dropped_frames == 0 || all == 0) return;
    const double share = double(run_.dropped_frames) / double(all);
    say("frames", level_of(-share, -kFewDropped, -kManyDropped),
        fmt::format("{} of {} frames were dropped", run_.dropped_frames, all), 100.0 * share, "%");
  }

  /// Share of the surface, from some of the vertices.
  double share_thinner_than(double thickness_m, const quality::ThinWalls& walls) const {
    const std::size_t stride = std::max<std::size_t>(1, areas_.size() / kThicknessSamples);
    double thin = 0.0, all = 0.0;
    for (std::size_t v = 0; v < areas_.size(); v += stride) {
      all += areas_[v];
      if (walls.thinner_than(thickness_m, v)) thin += areas_[v];
    }
    return all > 0.0 ? thin / all : 0.0;
  }

  void say_thin() {
    if (!object_.check.closed) return;
    const quality::ThinWalls walls(object_.mesh, normals_);
    const double nozzle = share_thinner_than(kNozzle_m, walls), pixels = 2.0 * run_.frame_spacing_m;
    if (nozzle > 0.002)
      say("thin", Level::kGood,
          fmt::format("{:.1f} % of it are walls thinner than 0.8 mm, which a usual nozzle does not "
                      "print",
                      100.0 * nozzle),
          100.0 * nozzle, "%");
    const double fine = pixels > kNozzle_m ? share_thinner_than(pixels, walls) : 0.0;
    if (fine > 0.02)
      say("thin", Level::kGood,
          fmt::format("{:.0f} % of it are walls thinner than {:.1f} mm, two pixels of the sensor: "
                      "how thick they are is uncertain",
                      100.0 * fine, pixels * 1e3),
          100.0 * fine, "%");
  }

  void say_mesh() {
    const bool watertight = object_.check.watertight();
    if (object_.left_open && !watertight) {
      say("mesh", Level::kGood, "it was left open, as asked for");
      return;
    }
    const bool printable = watertight && out_.level() != Level::kBad;
    say("mesh", watertight ? Level::kGood : Level::kBad,
        printable    ? "it is watertight and can be printed"
        : watertight ? "it is watertight, but much of it is not what stood on the table"
                     : fmt::format("it is not watertight ({})", object_.check.text()));
  }

  void say_help() {
    if (known_.turn && known_.turn->share < kWholeTurn)
      say("help", Level::kGood, "a whole turn would show the other sides");
    else if (invented_ > 0.5 * kGoodInvented)
      say("help", Level::kGood,
          "a second pass, the object laid another way, would show what none saw (turnscan scan "
          "--passes 2)");
    const auto error = std::find_if(out_.sentences.begin(), out_.sentences.end(),
                                    [](const VerdictSentence& s) { return s.topic == "error"; });
    if (error == out_.sentences.end() || error->level == Level::kGood || object_.quality.empty())
      return;
    const PoseError pose = pose_error(known_.choice);
    if (pose.shift_m > 0.0005)
      say("help", Level::kGood,
          "a better calibration would help most: let the sensor see the platter, and the table "
          "turn "
          "once or more");
    else
      say("help", Level::kGood,
          "a sensor nearer to the object, or more frames, would show it better");
  }

  ObjectResult& object_;
  const Reconstruction& run_;
  const ScanKnowledge& known_;
  std::vector<Vec3f> normals_;
  std::vector<double> areas_;
  std::vector<std::uint8_t> measured_;
  double invented_ = 0.0;  ///< share of the surface
  Verdict out_;
};

}  // namespace

std::vector<std::uint8_t> measured_vertices(const ObjectResult& object) {
  std::vector<std::uint8_t> out(object.mesh.vertices.size(), 1);
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] != Evidence::kMeasured)
      for (const std::uint32_t v : object.mesh.triangles[t]) out[v] = 0;
  return out;
}

void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known) {
  for (ObjectResult& object : reconstruction.objects)
    object.verdict = Judge(object, reconstruction, known).run();
}

}  // namespace turnscan
