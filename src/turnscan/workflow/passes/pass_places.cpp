#include <turnscan/workflow/passes/pass_places.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/seen_space.hpp>

namespace turnscan {

namespace {

using passes::PassMotion;
using passes::PassSurface;

constexpr std::size_t kFewestPoints = 200;  // that join_passes() takes
/// What is smaller than this share of the largest object is a crumb beside it.
constexpr double kCrumbShare = 0.1;

/// Stated motions that differ by more from what the surfaces show are doubted: metres, and
/// deviations of what they show.
constexpr double kDoubt_m = 0.001, kDoubtSigmas = 5.0;

/// Where a pass lies needs nothing but its surface.
ReconstructOptions for_surface(const ReconstructOptions& options) {
  ReconstructOptions out = options;
  out.surface.method = SurfaceMethod::kVolumetric;
  out.surface.repair = true;
  out.merge.pass.reset();
  out.finish = FinishOptions();
  out.volumetric.triangles.reset();
  out.volumetric.max_error_m.reset();
  out.volumetric.mark_invented = false;
  out.color = out.keep_points = false;
  out.keep_views = true;
  return out;
}

/// What joins the objects of a pass to those of others is one motion.
Result<> check_one_object(const Reconstruction& r) {
  std::size_t large = 0;
  for (const ObjectResult& object : r.objects)
    if (surface_area(object.mesh) > kCrumbShare * surface_area(r.objects[0].mesh)) ++large;
  if (large <= 1) return {};
  return fail(ErrorCode::kUnsupported,
              "{} objects stand on its table, and passes of one object only are brought together",
              large);
}

Result<PassSurface> surface_of(const PassOfMany& pass, const ReconstructOptions& options,
                               const RunContext& context) {
  TURNSCAN_ASSIGN(const JoinedFrames frames, JoinedFrames::create({pass.frames}));
  TURNSCAN_ASSIGN(const Reconstruction r, reconstruct(frames, for_surface(options), {}, context));
  TURNSCAN_TRY(check_one_object(r));
  PassSurface surface = passes::measured_surface(r.objects.at(0));
  if (surface.points.size() < kFewestPoints)
    return fail(ErrorCode::kTooFewPoints, "hardly anything of it was measured");
  surface.views = r.seen->views;
  surface.floor_m = r.seen->floor_m;
  surface.noise_m = r.seen->noise_m;
  return surface;
}

PassPlacement placement_of(const PassOfMany& pass, const Pose& T_first_pass) {
  PassPlacement placement;
  placement.T_object_table = T_first_pass;
  placement.turntable = pass.frames.frames->header().turntable;
  placement.name = pass.name;
  return placement;
}

/// How far two motions bring a surface apart, rms.
double apart_m(const PassSurface& surface, const Pose& one, const Pose& other) {
  double sum = 0.0;
  for (const Vec3f& p : surface.points)
    sum += (one * p.cast<double>() - other * p.cast<double>()).squaredNorm();
  return std::sqrt(sum / double(surface.points.size()));
}

/// Finds the motions of what nobody stated, and doubts of what somebody did.
class PassSearch {
 public:
  PassSearch(const std::vector<PassOfMany>& passes, std::vector<PassPlace>& places)
      : passes_(passes), places_(places) {}

  Result<> run(const ReconstructOptions& options, const RunContext& context) {
    const bool all_stated = std::all_of(places_.begin(), places_.end(), [](const PassPlace& place) {
      return place.placement.has_value();
    });
    TURNSCAN_TRY(add(0, !all_stated, options, context));
    for (std::size_t k = 1; k < passes_.size() && !surfaces_.empty(); ++k)
      TURNSCAN_TRY(add(k, false, options, context));
    if (surfaces_.size() < 2) return {};
    TURNSCAN_ASSIGN(const std::vector<PassMotion> motions,
                    passes::join_passes(surfaces_, {}, context));
    for (std::size_t i = 1; i < motions.size(); ++i) take(motions[i], i);
    return {};
  }

 private:
  /// A pass without a surface that is not needed is not joined, and does not keep others from it.
  Result<> add(std::size_t k, bool needed, const ReconstructOptions& options,
               const RunContext& context) {
    auto surface = surface_of(passes_[k], options, context);
    if (!surface && (needed || surface.error().code == ErrorCode::kCancelled)) {
      Error error = std::move(surface).error();
      if (error.code != ErrorCode::kCancelled)
        error.message = fmt::format("{}: {}", passes_[k].name, error.message);
      return tl::unexpected<Error>(std::move(error));
    }
    if (!surface) {
      places_[k].reason = surface.error().text();
      return {};
    }
    surfaces_.push_back(std::move(*surface));
    which_.push_back(k);
    return {};
  }

  void take(const PassMotion& motion, std::size_t surface) {
    const std::size_t k = which_[surface];
    if (!motion.joined) {
      places_[k].reason = motion.reason;
      return;
    }
    const Pose& first = places_[0].placement->T_object_table;
    if (places_[k].placement) {
      const double apart = apart_m(surfaces_[surface], first * motion.T_first_pass,
                                   places_[k].placement->T_object_table);
      if (apart > std::max(kDoubt_m, kDoubtSigmas * motion.sigma_m))
        places_[k].doubt = fmt::format(
            "{} lies {:.1f} mm from where its surface fits that of the first; it was taken as "
            "given",
            passes_[k].name, apart * 1e3);
      return;
    }
    PassPlacement placement = placement_of(passes_[k], first * motion.T_first_pass);
    placement.found = FoundMotion{motion.sigma_m, motion.sigma_rad, motion.overlap_m2};
    places_[k].placement = std::move(placement);
  }

  const std::vector<PassOfMany>& passes_;
  std::vector<PassPlace>& places_;
  std::vector<PassSurface> surfaces_;
  std::vector<std::size_t> which_;  // pass of each surface
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
      if (given != stated.end()) one.T_first_pass = given->T_first_table;
      out.push_back(std::move(one));
    }
  }
  TURNSCAN_TRY(check_stated(out, stated));
  return out;
}

Result<std::vector<PassPlace>> place_passes(const std::vector<PassOfMany>& passes,
                                            const ReconstructOptions& options,
                                            const RunContext& context) {
  std::vector<PassPlace> places(passes.size());
  for (std::size_t k = 0; k < passes.size(); ++k) {
    if (k == 0 || passes[k].T_first_pass)
      places[k].placement =
          placement_of(passes[k], passes[k].T_first_pass.value_or(Pose::Identity()));
  }
  TURNSCAN_TRY(PassSearch(passes, places).run(options, context));
  return places;
}

}  // namespace turnscan
