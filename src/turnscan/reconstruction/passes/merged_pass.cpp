#include <turnscan/reconstruction/passes/merged_pass.hpp>

#include <algorithm>

namespace turnscan::passes {

namespace {

/// Points this close to existing surface with a similar normal duplicate it.
constexpr float kBesideSame = 2.0f, kSameCos = 0.7f;

}  // namespace

MergedPass::MergedPass(std::span<const PreparedPass* const> passes,
                       std::span<const Pose> T_here_pass)
    : surface_(std::make_unique<PassSurface>()) {
  surface_->noise_m = 0.0;
  for (std::size_t k = 0; k < passes.size(); ++k) add(*passes[k], T_here_pass[k]);
  prepared_ = std::make_unique<PreparedPass>(*surface_);
  prepared_->free = FreeSpace();
  for (std::size_t k = 0; k < passes.size(); ++k)
    prepared_->free.add(passes[k]->free, T_here_pass[k].inverse());
}

void MergedPass::add(const PreparedPass& pass, const Pose& T_here_pass) {
  const PassSurface& from = *pass.surface;
  const KdTree there(surface_->points);
  const Eigen::Isometry3f T = T_here_pass.cast<float>();
  const float beside = kBesideSame * pass.beside_m + float(from.noise_m);
  const std::size_t before = surface_->points.size();
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const Vec3f p = T * from.points[i], n = T.linear() * from.normals[i];
    std::uint32_t near = 0;
    float squared = 0.0f;
    if (before > 0 && there.knn(p, 1, &near, &squared, beside) > 0 &&
        surface_->normals[near].dot(n) > kSameCos)
      continue;
    surface_->points.push_back(p);
    surface_->normals.push_back(n);
    surface_->areas.push_back(from.areas[i]);
    surface_->weights.push_back(from.weights[i]);
  }
  surface_->noise_m = std::max(surface_->noise_m, from.noise_m);
  surface_->spacing_m = std::max(surface_->spacing_m, from.spacing_m);
  surface_->filtered = surface_->filtered || from.filtered;
}

}  // namespace turnscan::passes
