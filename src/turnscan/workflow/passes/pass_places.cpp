#include <turnscan/workflow/passes/pass_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/motion_refinement.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/passes/pass_colors.hpp>

namespace turnscan {

namespace {

using passes::ObjectPart;
using passes::PassSurface;

constexpr std::size_t kMinPoints = 200;  // as required by join_passes()
/// Anything smaller than this share of the largest object is debris.
constexpr double kCrumbShare = 0.1;

/// Tolerances between stated motions and those found from the surfaces, above which the former are
/// doubted: metres, and standard deviations of the latter.
constexpr double kDoubt_m = 0.001, kDoubtSigmas = 5.0;

/// This many images per sensor determine a pass's pose as well as all of them; fusion, which
/// follows, uses all. If there are more, every second one, third one, ... is used.
constexpr std::size_t kPlacingImages = 300;

/// Registration of a pass only needs its surface.
ReconstructOptions for_surface(const ReconstructOptions& options) {
  ReconstructOptions out = options;
  out.surface.method = SurfaceMethod::kVolumetric;
  out.surface.repair = true;
  out.merge.pass.reset();
  out.finish = FinishOptions();
  out.texture = TextureOptions();
  out.volumetric.mark_invented = false;
  out.color = out.keep_points = false;
  out.for_placing = true;
  return out;
}

/// A measured pass: its objects, and which part of the table belongs to which of them.
struct MeasuredTable {
  std::vector<PassSurface> objects;      ///< largest first
  std::optional<ObjectPartition> share;  ///< if there are several
};

std::vector<std::size_t> images_for_placing(const FrameSequence& frames) {
  std::vector<std::size_t> seen(frames.header().sensors.size(), 0);
  for (const FrameInfo& info : frames.frames()) ++seen.at(info.sensor);
  std::vector<std::size_t> strides;
  for (std::size_t s = 0; s < seen.size(); ++s) {
    const bool images = frames.header().sensors[s].kind == SensorKind::kDepthCamera;
    strides.push_back(images ? 1 + seen[s] / (kPlacingImages + 1) : 1);
  }
  seen.assign(seen.size(), 0);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < frames.frames().size(); ++i) {
    const std::size_t sensor = frames.frames()[i].sensor;
    if (seen[sensor]++ % strides[sensor] == 0) out.push_back(i);
  }
  return out;
}

PassSurface united(std::vector<PassSurface>& pieces) {
  if (pieces.empty()) return {};
  PassSurface out = std::move(pieces[0]);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const PassSurface& more = pieces[k];
    out.points.insert(out.points.end(), more.points.begin(), more.points.end());
    out.normals.insert(out.normals.end(), more.normals.begin(), more.normals.end());
    out.areas.insert(out.areas.end(), more.areas.begin(), more.areas.end());
    out.weights.insert(out.weights.end(), more.weights.begin(), more.weights.end());
  }
  return out;
}

Result<MeasuredTable> measure_table(const PassOfMany& pass, const ReconstructOptions& options,
                                    const RunContext& context) {
  TURNSCAN_ASSIGN(const SequenceView all, join_passes({pass.frames}));
  const SequenceView frames(all, images_for_placing(all));
  TURNSCAN_ASSIGN(const Reconstruction r, reconstruct(frames, for_surface(options), {}, context));
  MeasuredTable out;
  std::vector<const TriangleMesh*> meshes;
  for (const ObjectResult& object : r.objects) {
    if (surface_area(object.mesh) < kCrumbShare * surface_area(r.objects[0].mesh)) continue;
    PassSurface surface = passes::measured_surface(object, r.seen);
    if (surface.points.size() < kMinPoints) continue;
    out.objects.push_back(std::move(surface));
    meshes.push_back(&object.mesh);
  }
  // A few views from arbitrary positions show an object in pieces; only tables carry several
  // objects.
  if (!pass.frames.frames->header().turntable) out = {{united(out.objects)}, {}};
  if (out.objects.empty() || out.objects[0].points.size() < kMinPoints)
    return fail(ErrorCode::kTooFewPoints, "hardly anything of it was measured");
  if (out.objects.size() > 1) out.share.emplace(meshes);
  return out;
}

PassPlacement placement_of(const PassOfMany& pass, const Pose& T_object_table) {
  PassPlacement placement;
  placement.T_object_table = T_object_table;
  placement.turntable = pass.frames.frames->header().turntable;
  placement.name = pass.name;
  return placement;
}

/// RMS distance between a surface under two motions.
double apart_m(const PassSurface& surface, const Pose& one, const Pose& other) {
  double sum = 0.0;
  for (const Vec3f& p : surface.points)
    sum += (one * p.cast<double>() - other * p.cast<double>()).squaredNorm();
  return std::sqrt(sum / double(surface.points.size()));
}

/// Finds the poses that were not stated, and checks those that were.
class PassSearch {
 public:
  explicit PassSearch(const std::vector<PassOfMany>& passes) : passes_(passes) {
    out_.reasons.resize(passes.size());
    out_.left.resize(passes.size());
    tables_.resize(passes.size());
  }

  Result<PassPlaces> run(const ReconstructOptions& options, const RunContext& context) {
    TURNSCAN_TRY(measure(options, context));
    TURNSCAN_TRY(check_stated_tables());
    TURNSCAN_ASSIGN(const auto objects, join(context));
    if (several_objects() && !any_stated()) {
      for (const auto& parts : objects) take_object(parts);
    } else {
      TURNSCAN_TRY(take_passes(objects, context));
    }
    note_colors(objects);
    note_what_is_left(objects);
    return std::move(out_);
  }

 private:
  /// A pass that has no surface and is not required is not joined, and does not prevent others from
  /// being joined.
  Result<> measure(const ReconstructOptions& options, const RunContext& context) {
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      auto table = measure_table(passes_[k], options, context);
      const bool needed = k == 0 && !all_stated();
      if (!table && (needed || table.error().code == ErrorCode::kCancelled)) {
        Error error = std::move(table).error();
        if (error.code != ErrorCode::kCancelled)
          error.message = fmt::format("{}: {}", passes_[k].name, error.message);
        return tl::unexpected<Error>(std::move(error));
      }
      if (table)
        tables_[k] = std::move(*table);
      else
        unmeasured_[k] = table.error().text();
    }
    return {};
  }

  /// The first pass defines the frame.
  bool is_stated(std::size_t k) const {
    return k == 0 || (passes_[k].T_first_pass && !passes_[k].refine);
  }
  bool any_stated() const {
    return std::any_of(passes_.begin(), passes_.end(),
                       [](const PassOfMany& pass) { return pass.T_first_pass.has_value(); });
  }
  bool all_stated() const {
    for (std::size_t k = 0; k < passes_.size(); ++k)
      if (!is_stated(k)) return false;
    return true;
  }
  bool several_objects() const {
    return std::any_of(tables_.begin(), tables_.end(),
                       [](const MeasuredTable& table) { return table.objects.size() > 1; });
  }

  Result<> check_stated_tables() const {
    if (all_stated() || !any_stated()) return {};
    for (std::size_t k = 0; k < passes_.size(); ++k)
      if (tables_[k].objects.size() > 1)
        return fail(ErrorCode::kUnsupported,
                    "{}: {} objects stand on its table, and --pass-pose moves them as one; state "
                    "the poses of all passes as they are, or of none",
                    passes_[k].name, tables_[k].objects.size());
    return {};
  }

  Result<std::vector<std::vector<ObjectPart>>> join(const RunContext& context) {
    // Stated poses of several objects are not questioned.
    if (several_objects() && any_stated()) return std::vector<std::vector<ObjectPart>>();
    std::vector<std::vector<PassSurface>> surfaces;
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      surfaces.push_back(tables_[k].objects);
      if (passes_[k].refine) surfaces.back().clear();  // excluded from the search
    }
    return passes::join_objects(surfaces, {}, context,
                                [&] { return color_tables(surfaces, context); });
  }

  /// Whether at least two passes have colours. Colours are used only if shapes are ambiguous.
  Result<bool> color_tables(std::vector<std::vector<PassSurface>>& surfaces,
                            const RunContext& context) const {
    std::size_t colored = 0;
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      TURNSCAN_TRY(color_surfaces(passes_[k].frames, surfaces[k], context));
      colored += std::any_of(surfaces[k].begin(), surfaces[k].end(),
                             [](const PassSurface& object) { return !object.colors.empty(); });
    }
    return colored > 1;
  }

  void take_object(const std::vector<ObjectPart>& parts) {
    if (parts.size() < 2) return;
    ObjectPlaces& object = out_.objects.emplace_back();
    object.of_pass.resize(passes_.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const ObjectPart& part = parts[i];
      PassPlacement placement = placement_of(passes_[part.pass], part.motion.T_first_pass);
      if (i > 0) placement.found = found(part);
      if (const auto& share = tables_[part.pass].share)
        placement.share = share->of(std::array{part.object});
      object.of_pass[part.pass] = std::move(placement);
      if (part.motion.interchangeable)
        out_.notes.push_back(
            fmt::format("in {} two objects have the same shape wherever both were measured; which "
                        "of them is matched with which of the other passes does not matter",
                        passes_[part.pass].name));
    }
  }

  static FoundMotion found(const ObjectPart& part) {
    return {part.motion.sigma_m, part.motion.sigma_rad, part.motion.overlap_m2};
  }

  /// For one object: everything connected with the first pass or with a stated one gets its pose
  /// through it; each remaining connected group is an object of its own.
  Result<> take_passes(const std::vector<std::vector<ObjectPart>>& groups,
                       const RunContext& context) {
    ObjectPlaces first;
    first.of_pass.resize(passes_.size());
    for (std::size_t k = 0; k < passes_.size(); ++k)
      if (is_stated(k))
        first.of_pass[k] =
            placement_of(passes_[k], passes_[k].T_first_pass.value_or(Pose::Identity()));
    std::vector<const std::vector<ObjectPart>*> others;
    for (const auto& parts : groups) {
      const auto anchor = std::find_if(
          parts.begin(), parts.end(), [&](const ObjectPart& part) { return is_stated(part.pass); });
      if (anchor == parts.end())
        others.push_back(&parts);
      else
        place_through(*anchor, parts, first);
    }
    for (std::size_t k = 1; k < passes_.size(); ++k)
      if (passes_[k].refine) TURNSCAN_TRY(place_roughly_stated(k, first, context));
    const auto count = std::count_if(first.of_pass.begin(), first.of_pass.end(),
                                     [](const auto& place) { return place.has_value(); });
    if (count > 1) out_.objects.push_back(std::move(first));
    for (const auto* parts : others) take_object(*parts);
    return {};
  }

  /// Registers it to the passes that already have poses.
  Result<> place_roughly_stated(std::size_t k, ObjectPlaces& object, const RunContext& context) {
    if (tables_[k].objects.empty()) return {};  // the reason is already recorded
    std::vector<passes::PlacedSurface> placed;
    for (std::size_t i = 0; i < passes_.size(); ++i)
      if (object.of_pass[i] && !tables_[i].objects.empty())
        placed.push_back({&tables_[i].objects[0], object.of_pass[i]->T_object_table});
    TURNSCAN_ASSIGN(const passes::RefinedMotion refined,
                    passes::refine_motion(placed, tables_[k].objects[0], *passes_[k].T_first_pass,
                                          {}, context));
    if (!refined.misfit.empty()) {
      out_.reasons[k] = "as it was placed, " + refined.misfit;
      return {};
    }
    object.of_pass[k] = placement_of(passes_[k], refined.T_here_pass);
    object.of_pass[k]->found = {refined.sigma_m, refined.sigma_rad, refined.overlap_m2};
    return {};
  }

  void place_through(const ObjectPart& anchor, const std::vector<ObjectPart>& parts,
                     ObjectPlaces& object) {
    const Pose T =
        object.of_pass[anchor.pass]->T_object_table * anchor.motion.T_first_pass.inverse();
    for (const ObjectPart& part : parts) {
      auto& place = object.of_pass[part.pass];
      const Pose T_object_table = T * part.motion.T_first_pass;
      if (!place) {
        place = placement_of(passes_[part.pass], T_object_table);
        place->found = found(part);
      } else if (part.pass != anchor.pass) {
        doubt(part, T_object_table, place->T_object_table);
      }
    }
  }

  void doubt(const ObjectPart& part, const Pose& shown, const Pose& stated) {
    const double apart = apart_m(tables_[part.pass].objects[part.object], shown, stated);
    if (apart > std::max(kDoubt_m, kDoubtSigmas * part.motion.sigma_m))
      out_.notes.push_back(fmt::format(
          "{} lies {:.1f} mm from where its surface fits that of the first; it was taken as given",
          passes_[part.pass].name, apart * 1e3));
  }

  bool is_placed(std::size_t k) const {
    return std::any_of(out_.objects.begin(), out_.objects.end(),
                       [&](const ObjectPlaces& object) { return object.of_pass[k].has_value(); });
  }

  void note_colors(const std::vector<std::vector<ObjectPart>>& groups) {
    for (const auto& parts : groups)
      for (const ObjectPart& part : parts)
        if (part.motion.by_colors)
          out_.notes.push_back(
              fmt::format("{} was joined by its colours: its shape alone left open how it lay",
                          passes_[part.pass].name));
  }

  void note_what_is_left(const std::vector<std::vector<ObjectPart>>& groups) {
    std::vector<std::vector<std::size_t>> left(passes_.size());
    for (std::size_t k = 0; k < passes_.size(); ++k)
      if (!unmeasured_[k].empty() && !is_placed(k)) out_.reasons[k] = unmeasured_[k];
    for (const auto& parts : groups) {
      if (parts.size() > 1) continue;
      const ObjectPart& part = parts[0];
      const MeasuredTable& table = tables_[part.pass];
      if (table.objects.size() == 1 && is_placed(part.pass)) continue;
      left[part.pass].push_back(part.object);
      std::string& reason = out_.reasons[part.pass];
      if (table.objects.size() > 1)
        reason += fmt::format("{}object {}: ", reason.empty() ? "" : "; ", part.object + 1);
      reason += part.motion.reason;
    }
    // If nothing was joined, the others did not fit the first pass, which needs no reason itself.
    if (out_.objects.empty()) out_.reasons[0].clear();
    for (std::size_t k = 0; k < passes_.size(); ++k)
      if (!left[k].empty() && left[k].size() < tables_[k].objects.size())
        out_.left[k] = tables_[k].share->of(left[k]);
  }

  const std::vector<PassOfMany>& passes_;
  std::vector<MeasuredTable> tables_;
  std::map<std::size_t, std::string> unmeasured_;  // with reasons
  PassPlaces out_;
};

Result<> check_stated(const std::vector<PassOfMany>& passes, const std::vector<PassPose>& stated) {
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const auto is_same = [&](const auto& other) { return other == stated[i].pass; };
    if (std::none_of(passes.begin(), passes.end(),
                     [&](const PassOfMany& p) { return is_same(p.number); }))
      return fail(ErrorCode::kInvalidOption, "--pass-pose {}: there is no such pass",
                  stated[i].pass);
    if (std::any_of(stated.begin(), stated.begin() + std::ptrdiff_t(i),
                    [&](const PassPose& p) { return is_same(p.pass); }))
      return fail(ErrorCode::kInvalidOption, "--pass-pose {} is given twice", stated[i].pass);
  }
  return {};
}

}  // namespace

Result<std::vector<PassOfMany>> list_passes(const std::vector<RecordingFrames>& recordings,
                                            const std::vector<PassPose>& stated) {
  std::vector<PassOfMany> out;
  for (const RecordingFrames& recording : recordings) {
    for (const std::uint32_t pass : passes_of(*recording.frames)) {
      PassOfMany one;
      one.frames = {recording.frames, pass, recording.speed_rad_s};
      one.number = recordings.size() == 1 ? pass : std::uint32_t(out.size());
      one.name = fmt::format("pass {}", one.number);
      if (recordings.size() > 1) one.name += fmt::format(" ({})", recording.name);
      const auto given = std::find_if(stated.begin(), stated.end(),
                                      [&](const PassPose& p) { return p.pass == one.number; });
      if (given != stated.end()) {
        one.T_first_pass = given->T_first_table;
        one.refine = given->refine;
      }
      out.push_back(std::move(one));
    }
  }
  TURNSCAN_TRY(check_stated(out, stated));
  return out;
}

Result<PassPlaces> place_passes(const std::vector<PassOfMany>& passes,
                                const ReconstructOptions& options, const RunContext& context) {
  return PassSearch(passes).run(options, context);
}

}  // namespace turnscan
