#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/finishing/hole_patches.hpp>
#include <turnscan/reconstruction/quality/thin_walls.hpp>
#include <turnscan/workflow/calibration/reduced_frames.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/verdict/error_shares.hpp>
#include <turnscan/workflow/verdict/pose_error.hpp>
#include <turnscan/workflow/verdict/scan_sentences.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

namespace turnscan {

namespace {

constexpr double kTolerance_m = 0.001;
/// Share of the seen surface within the tolerance. The F-score, which it approximates, is a
/// hundredth higher.
constexpr double kGoodShare = 0.96, kFairShare = 0.84;
/// Share of the surface visible in hardly any frame. If that is not known, the unmeasured surface
/// is used, which is 4 % more on average.
constexpr double kGoodHidden = 0.10, kFairHidden = 0.25, kNotMeasuredMore = 0.04;
/// Frames that see a place, below which nothing confirms what one frame measured.
constexpr double kConfirmed = 2.0;
/// Number of frames that see a point; more do not help as much as a closer sensor.
constexpr int kManyFrames = 40;
/// Share of the volume that lies behind hollows, which makes it amber, and which is mentioned.
constexpr double kFairUnknown = 0.15, kShownUnknown = 0.03;
constexpr double kNozzle_m = 0.0008;
constexpr double kShownWorth = 0.03;  ///< share of the surface that another pass would show
constexpr double kPoseMatters_m = 0.0005;
constexpr std::size_t kThicknessSamples = 4000, kNamedHoles = 3;

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> out(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double third = triangle_area(mesh, t) / 3.0;
    for (const std::uint32_t v : mesh.triangles[t]) out[v] += third;
  }
  return out;
}

/// Weighted quantile: the smallest value that this share of the weight does not exceed.
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
  /// position: of the object in `known`.
  Judge(ObjectResult& object, std::size_t position, const Reconstruction& run,
        const ScanKnowledge& known)
      : object_(object),
        residuals_(position < known.residuals.size() ? &known.residuals[position] : nullptr),
        seen_(position < known.seen.size() ? &known.seen[position] : nullptr),
        next_pass_(position == 0 && known.next_pass ? &*known.next_pass : nullptr),
        run_(run),
        known_(known),
        normals_(vertex_normals(object.mesh)),
        areas_(vertex_areas(object.mesh)),
        measured_(measured_vertices(object)) {}

  Verdict run() {
    add_pose_errors();
    workflow::add_plausibility(known_, out_.sentences);
    workflow::add_turn(known_, out_.sentences);
    add_seen();
    add_error();
    add_invented();
    add_unknown_volume();
    workflow::add_calibration(known_, out_.sentences);
    if (residuals_ != nullptr) workflow::add_agreement(*residuals_, out_.sentences);
    workflow::add_disturbances(known_, out_.sentences);
    workflow::add_dropped(run_, out_.sentences);
    add_thin();
    add_mesh();
    add_help();
    return std::move(out_);
  }

 private:
  void say(std::string topic, Level level, std::string text, double value = std::nan(""),
           std::string unit = "") {
    out_.sentences.push_back({std::move(topic), level, std::move(text), value, std::move(unit)});
  }

  /// Adds the uncertainty left by the calibration, which all frames share.
  void add_pose_errors() {
    if (object_.quality.empty()) return;
    const PoseError error = pose_error(known_);
    const Vec3d middle = bounds(object_.mesh.vertices).center();
    for (std::size_t v = 0; v < object_.quality.size(); ++v) {
      const Vec3d arm = object_.mesh.vertices[v].cast<double>() - middle;
      float& expected = object_.quality[v].expected_error_m;
      expected = float(
          std::hypot(double(expected), error.along_normal_m(arm, normals_[v].cast<double>())));
    }
  }

  void add_seen() {
    if (object_.quality.empty()) return;
    std::vector<std::pair<int, double>> frames, directions;
    for (std::size_t v = 0; v < areas_.size(); ++v) {
      if (!measured_[v]) continue;
      frames.emplace_back(object_.quality[v].frames, areas_[v]);
      directions.emplace_back(object_.quality[v].directions, areas_[v]);
    }
    const int usual = weighted_quantile(frames, 0.5), least = weighted_quantile(frames, 0.05);
    say("seen", usual >= kConfirmed ? Level::kGood : Level::kFair,
        fmt::format("Half of the measured surface was seen by {} frames or more, from {} or more "
                    "directions (30 degrees each). 5 % of it was seen by {} or fewer.",
                    usual, weighted_quantile(directions, 0.5), least),
        usual, "frames");
  }

  void add_error() {
    if (object_.quality.empty()) {
      say("error", Level::kFair,
          "How far it lies from the truth is estimated with --method volumetric only.");
      return;
    }
    const ErrorShares errors = error_shares();
    const double share = errors.within(kTolerance_m);
    const auto median_m = errors.error_of(0.5), most_m = errors.error_of(0.95);
    if (!median_m) {
      say("error", Level::kFair,
          "How far it lies from the truth is not known, because too few frames see each place.");
      return;
    }
    const std::string most =
        most_m ? fmt::format("95 % of it lies within {:.2f} mm, and {:.1f} % within 1 mm",
                             *most_m * 1e3, 100.0 * share)
               : fmt::format(
                     "{:.1f} % of it lies within 1 mm. How far the worst 5 % of it lies is "
                     "not known",
                     100.0 * share);
    say("error", workflow::level_of(share, kGoodShare, kFairShare),
        fmt::format("The measured surface is expected to lie {:.2f} mm from the truth in the "
                    "median. {}.",
                    *median_m * 1e3, most),
        *median_m * 1e3, "mm");
  }

  /// Of the surface that frames could see; if that is not known, of what they measured.
  ErrorShares error_shares() const {
    ErrorShares out;
    if (seen_ != nullptr) {
      for (std::size_t i = 0; i < seen_->vertices.size(); ++i) {
        const std::uint32_t v = seen_->vertices[i];
        if (seen_->seen[i] != 0) out.add(object_.quality[v].expected_error_m, areas_[v]);
      }
      return out;
    }
    for (std::size_t v = 0; v < areas_.size(); ++v)
      if (measured_[v]) out.add(object_.quality[v].expected_error_m, areas_[v]);
    return out;
  }

  /// Share of the vertices' area visible in hardly any frame.
  std::optional<double> hidden_share() const {
    if (seen_ == nullptr || seen_->vertices.empty()) return std::nullopt;
    double hidden = 0.0, all = 0.0;
    for (std::size_t i = 0; i < seen_->vertices.size(); ++i) {
      const double area = areas_[seen_->vertices[i]];
      all += area;
      if (seen_->seen[i] == 0) hidden += area;
    }
    return all > 0.0 ? hidden / all : 0.0;
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
    return fmt::format("{:.1f} cm2 {} at a height of {:.0f} mm", hole.area_m2 * 1e4, side,
                       middle.y() * 1e3);
  }

  /// Standard deviation of the height of the base if it is not known within the tolerance: without
  /// a platter it is where the object was seen to end.
  std::optional<double> unknown_height_m() const {
    if (known_.choice == nullptr || !known_.choice->calibration) return std::nullopt;
    const double sigma_m = known_.choice->calibration->height_sigma_m;
    return sigma_m > kTolerance_m ? std::optional(sigma_m) : std::nullopt;
  }

  void add_invented() {
    if (object_.evidence.empty()) return;
    double base_m2 = 0.0;
    std::vector<Evidence> hidden = object_.evidence;
    for (std::size_t t = 0; t < hidden.size(); ++t) {
      if (hidden[t] == Evidence::kInvented) continue;
      if (hidden[t] == Evidence::kBase) base_m2 += triangle_area(object_.mesh, t);
      hidden[t] = Evidence::kMeasured;
    }
    const double area_m2 = std::max(surface_area(object_.mesh), 1e-12);
    const double invented = object_.invented_area_m2 / area_m2, base = base_m2 / area_m2;
    const auto unseen = hidden_share();
    hidden_ = unseen ? std::max(0.0, *unseen - base) : std::max(0.0, invented - kNotMeasuredMore);
    const auto height_sigma_m = unknown_height_m();
    if (height_sigma_m) hidden_ += base;
    hidden_ += object_.no_return_area_m2 / area_m2;
    auto holes = finishing::find_hole_patches(object_.mesh, hidden);
    std::sort(holes.begin(), holes.end(),
              [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
    std::string largest;
    for (std::size_t i = 0; i < std::min(holes.size(), kNamedHoles); ++i)
      if (holes[i].area_m2 > 1e-4)
        largest += fmt::format("{}{}", largest.empty() ? " The largest holes: " : ", ",
                               place_of(object_.mesh, holes[i]));
    std::string text =
        fmt::format("{:.1f} cm2 ({:.0f} %) of the surface was not measured but closed.",
                    object_.invented_area_m2 * 1e4, 100.0 * invented);
    if (base > 0.0 && height_sigma_m)
      text += fmt::format(" {:.1f} cm2 ({:.0f} %) is the base, whose height is known to {:.1f} mm.",
                          base_m2 * 1e4, 100.0 * base, *height_sigma_m * 1e3);
    else if (base > 0.0)
      text += fmt::format(" {:.1f} cm2 ({:.0f} %) is the base, which stood on the platter.",
                          base_m2 * 1e4, 100.0 * base);
    if (unseen)
      text += fmt::format(" Hardly a frame could see {:.1f} cm2 ({:.0f} %){}{}.",
                          hidden_ * area_m2 * 1e4, 100.0 * hidden_,
                          height_sigma_m ? "" : " besides the base",
                          !(object_.no_return_area_m2 > 0.0) ? ""
                          : object_.too_near ? ", or it returned nothing because it was too near"
                                             : ", or it returned nothing");
    say("invented", workflow::level_of(1.0 - hidden_, 1.0 - kGoodHidden, 1.0 - kFairHidden),
        text + (largest.empty() ? "" : largest + "."), 100.0 * invented, "%");
  }

  void add_unknown_volume() {
    const double volume_m3 = signed_volume(object_.mesh);
    if (!(volume_m3 > 0.0) || object_.left_open) return;
    const double share = object_.unknown_volume_m3 / volume_m3;
    if (share < kShownUnknown) return;
    say("hollow", share > kFairUnknown ? Level::kFair : Level::kGood,
        fmt::format("{:.0f} of its {:.0f} cm3 ({:.0f} %) lie in a hollow whose floor no frame saw, "
                    "and are filled. Look in from higher, or leave the hollow open with --holes "
                    "open.",
                    object_.unknown_volume_m3 * 1e6, volume_m3 * 1e6, 100.0 * share),
        100.0 * share, "%");
  }

  /// Share of the surface, estimated from a subset of the vertices.
  double share_thinner_than(double thickness_m, const quality::ThinWalls& walls) const {
    const std::vector<std::size_t> chosen = evenly_spread(areas_.size(), kThicknessSamples);
    std::vector<std::uint8_t> is_thin(chosen.size());
    parallel_for(chosen.size(), 64, [&](std::size_t i) {
      is_thin[i] = walls.thinner_than(thickness_m, chosen[i]) ? 1 : 0;
    });
    double thin = 0.0, all = 0.0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      all += areas_[chosen[i]];
      if (is_thin[i]) thin += areas_[chosen[i]];
    }
    return all > 0.0 ? thin / all : 0.0;
  }

  void add_thin() {
    if (!object_.check.closed) return;
    const quality::ThinWalls walls(object_.mesh, normals_);
    const double nozzle = share_thinner_than(kNozzle_m, walls), pixels = 2.0 * run_.frame_spacing_m;
    if (nozzle > 0.002)
      say("thin", Level::kGood,
          fmt::format("Walls thinner than 0.8 mm, which a usual nozzle does not print, make up "
                      "{:.1f} % of the surface.",
                      100.0 * nozzle),
          100.0 * nozzle, "%");
    const double fine = pixels > kNozzle_m ? share_thinner_than(pixels, walls) : 0.0;
    if (fine > 0.02)
      say("thin", Level::kGood,
          fmt::format("Walls thinner than {:.1f} mm, two pixels of the sensor, make up {:.0f} % of "
                      "the surface. Their thickness is uncertain.",
                      pixels * 1e3, 100.0 * fine),
          100.0 * fine, "%");
  }

  void add_mesh() {
    const bool watertight = object_.check.watertight();
    if (object_.left_open && !watertight) {
      say("mesh", Level::kGood, "It was left open, as asked for.");
      return;
    }
    if (!watertight)
      say("mesh", Level::kBad, fmt::format("It is not watertight ({}).", object_.check.text()));
    else if (out_.level() == Level::kBad)
      say("mesh", Level::kFair, "It is watertight, but much of it is not what stood on the table.");
    else if (!looked_from_all_sides())
      say("mesh", Level::kFair,
          "It is watertight, but no frame looks at one side of it. How deep it is there is a "
          "guess.");
    else if (object_.check.crossing_edges > 0)
      say("mesh", Level::kFair,
          fmt::format("It is watertight, but passes through itself: {} edges pass through other "
                      "triangles.",
                      object_.check.crossing_edges));
    else
      say("mesh", Level::kGood, "It is watertight and can be printed.");
  }

  bool looked_from_all_sides() const {
    return !known_.turn || workflow::looked_from_all_sides(*known_.turn);
  }

  /// The best pose for another pass; nullptr if no advice is worth the effort.
  const NextPose* best_pose() const {
    if (next_pass_ == nullptr || next_pass_->poses.empty()) return nullptr;
    const NextPose& best = next_pass_->poses.front();
    return best.shows_m2 > kShownWorth * surface_area(object_.mesh) ? &best : nullptr;
  }

  /// Number of passes that made the largest object.
  std::size_t passes() const {
    const auto made = std::count_if(run_.passes.begin(), run_.passes.end(),
                                    [](const FusedPass& pass) { return pass.object <= 0; });
    return std::max<std::size_t>(1, std::size_t(made));
  }

  void add_help() {
    const char* further = passes() == 1 ? "A second pass" : "Another pass";
    const std::string how = fmt::format("(turnscan scan --passes {})", passes() + 1);
    if (!looked_from_all_sides())
      say("help", Level::kGood, "A whole turn would show the other sides.");
    else if (const NextPose* pose = best_pose())
      say("help", Level::kGood,
          fmt::format("{} would show {:.0f} cm2 more: {} {}.", further, pose->shows_m2 * 1e4,
                      deed_text(*pose), how),
          pose->shows_m2 * 1e4, "cm2");
    else if (hidden_ > 0.5 * kGoodHidden)
      say("help", Level::kGood,
          fmt::format("{}, with the object laid another way, would show what no frame saw {}.",
                      further, how));
    if (object_.too_near)
      say("help", Level::kGood,
          "Move the sensor farther away: parts of the object are nearer than anything that it "
          "measured.");
    add_what_helps_accuracy();
  }

  void add_what_helps_accuracy() {
    const auto topic = [&](const char* name) {
      return std::find_if(out_.sentences.begin(), out_.sentences.end(),
                          [&](const VerdictSentence& s) { return s.topic == name; });
    };
    const auto error = topic("error"), seen = topic("seen");
    if (object_.quality.empty() || error == out_.sentences.end() || error->level == Level::kGood)
      return;
    const PoseError pose = pose_error(known_);
    if (pose.shift_m > kPoseMatters_m)
      say("help", Level::kGood,
          "A better calibration would help most. Record a turn or more, with the platter in view "
          "if there is one.");
    else if (seen != out_.sentences.end() && seen->value < kManyFrames)
      say("help", Level::kGood,
          fmt::format("Let the table turn at a quarter of the speed, or take four times as many "
                      "frames a second. Then {:.0f} frames see what {:.0f} saw, and noise averages "
                      "to half.",
                      4.0 * seen->value, seen->value));
    else if (!object_.too_near)
      say("help", Level::kGood,
          "Move the sensor to half the distance. Its pixels then lie half as far apart, and noise "
          "is smaller.");
  }

  ObjectResult& object_;
  const std::vector<FrameResidual>* residuals_;
  const SeenVertices* seen_;
  const NextPassAdvice* next_pass_;
  const Reconstruction& run_;
  const ScanKnowledge& known_;
  std::vector<Vec3f> normals_;
  std::vector<double> areas_;
  std::vector<std::uint8_t> measured_;
  double hidden_ = 0.0;  ///< share of the surface visible in hardly any frame
  Verdict out_;
};

}  // namespace

Result<> compare_object(const ObjectResult& object, const std::vector<MeshFrames>& frames,
                        double noise_m, const RunContext& context, ScanKnowledge& known) {
  std::vector<SequenceView> sequences;
  sequences.reserve(frames.size());
  std::vector<MeshFrames> reduced = frames;
  for (MeshFrames& of : reduced)
    of.frames =
        &sequences.emplace_back(workflow::reduced_frames(*of.frames, workflow::kPixelsToCheck));
  TURNSCAN_ASSIGN(auto residuals, frame_residuals(object, reduced, noise_m, context));
  TURNSCAN_ASSIGN(auto seen, seen_vertices(object.mesh, reduced, context));
  known.residuals.push_back(std::move(residuals));
  known.seen.push_back(std::move(seen));
  return {};
}

void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known) {
  for (std::size_t i = 0; i < reconstruction.objects.size(); ++i)
    reconstruction.objects[i].verdict =
        Judge(reconstruction.objects[i], i, reconstruction, known).run();
}

}  // namespace turnscan
