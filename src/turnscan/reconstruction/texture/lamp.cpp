#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/lamp.hpp>

namespace turnscan::texture {

namespace {

constexpr std::size_t kLightBlocks = 4000;     // blocks used for the search
constexpr std::size_t kLookTriangles = 8'000;  // of the mesh that casts shadows during the search
constexpr double kLookMap_px = 200.0;          // across the object
constexpr double kMap_px = 800.0;
constexpr double kUsualDisagreement = 0.1;  // of albedos
constexpr double kMinCompared = 0.3;    // share of the comparisons that must remain outside shadow
                                        // edges
constexpr double kMinExplained = 2e-3;  // below this there is no lamp
constexpr int kMaxRounds = 40;
constexpr double kMinStep = 0.004;

/// A block as used in the search.
struct LightBlock {
  Vec3f position, normal;  ///< object's frame
  std::array<float, kSlots> luminance{};
  std::array<std::uint16_t, kSlots> view{};
  std::size_t count = 0;
};

std::vector<LightBlock> light_blocks(const LampScene& scene, const std::vector<Vec3f>& gains) {
  std::vector<LightBlock> out;
  const std::size_t step = std::max<std::size_t>(1, scene.means.size() / kLightBlocks);
  for (std::size_t b = 0; b < scene.means.size(); b += step) {
    LightBlock block;
    for (std::size_t k = 0; k < kSlots; ++k) {
      if (!tells_of_exposure(scene.means[b][k])) continue;
      block.view[block.count] = scene.chosen.view[b][k];
      block.luminance[block.count++] =
          scene.means[b][k].cwiseProduct(gains[scene.chosen.view[b][k]]).sum();
    }
    if (block.count < 3) continue;
    const int texel = scene.blocks.middle_texel(b);
    block.position = scene.blocks.surface(b, texel).position;
    block.normal = scene.blocks.normal(b, texel);
    out.push_back(block);
  }
  return out;
}

double pixel_of(const TriangleMesh& mesh, double across_px) {
  return std::max(1e-6, double(bounds(mesh.vertices).size().norm()) / across_px);
}

FixedLight light_from(double azimuth, double elevation, double share) {
  FixedLight light;
  light.direction = rig_direction(azimuth, elevation);
  light.ambient = float(1.0 - share);
  light.lamp = float(share);
  return light;
}

/// Evaluates lights.
class LampSearch {
 public:
  LampSearch(const LampScene& scene, std::vector<LightBlock> blocks, const RunContext& context)
      : scene_(scene), blocks_(std::move(blocks)), context_(context) {
    of_view_.resize(scene.rotation.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t k = 0; k < blocks_[b].count; ++k)
        of_view_[blocks_[b].view[k]].push_back({std::uint32_t(b), std::uint8_t(k)});
    pixel_ = pixel_of(scene.coarse, kLookMap_px);
  }

  void start(const std::optional<FixedLight>& near) {
    if (near && near->lamp > 0.0f) {
      const Vec3f& d = near->direction;
      look(std::atan2(double(d.x()), double(d.z())), std::asin(std::clamp(double(d.y()), -1., 1.)),
           {double(near->lamp / (near->lamp + near->ambient))});
      step_angle_ = kTurn / 72, step_share_ = 0.06;
      return;
    }
    for (int e = -1; e <= 4; ++e) {
      const int around = e == 4 ? 6 : 14;
      for (int a = 0; a < around; ++a)
        look(a * kTurn / around, e * kTurn / 20, {0.2, 0.45, 0.7, 0.9});
    }
    step_angle_ = kTurn / 36, step_share_ = 0.12;
  }

  void refine() {
    for (int round = 0;
         round < kMaxRounds && step_angle_ > kMinStep && share_ > 0.0 && !context_.cancelled();
         ++round) {
      const double a = azimuth_, e = elevation_, s = share_;
      const std::initializer_list<double> shares{s - step_share_, s, s + step_share_};
      const double wide = step_angle_ / std::max(0.2, std::cos(e));
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) look(a + i * wide, e + j * step_angle_, shares);
      if (azimuth_ == a && elevation_ == e && share_ == s) step_angle_ *= 0.5, step_share_ *= 0.6;
    }
  }

  /// Its mean over the observed surface is 1.
  FixedLight best() const {
    FixedLight light = light_from(azimuth_, elevation_, share_);
    double mean = 0.0, count = 0.0;
    const auto reached = reached_by(light.direction);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t k = 0; k < blocks_[b].count; ++k, count += 1.0)
        mean += double(light_on(b, k, light, reached[b][k] != Lit::kNo));
    if (count == 0.0) return {};
    light.ambient *= float(count / mean);
    light.lamp *= float(count / mean);
    return light;
  }

 private:
  using Reached = std::vector<std::array<Lit, kSlots>>;

  Reached reached_by(const Vec3f& direction) const {
    Reached out(blocks_.size());
    parallel_for(of_view_.size(), 1, [&](std::size_t view) {
      if (of_view_[view].empty() || context_.cancelled()) return;
      const LampView lamp(scene_.coarse, scene_.rotation[view].transpose() * direction, pixel_);
      for (const auto& [b, k] : of_view_[view])
        out[b][k] = lamp.lit(blocks_[b].position, blocks_[b].normal);
    });
    return out;
  }

  float light_on(std::size_t b, std::size_t k, const FixedLight& light, bool reached) const {
    const Vec3f normal_rig = scene_.rotation[blocks_[b].view[k]] * blocks_[b].normal;
    return light.on(normal_rig.dot(light.direction), reached);
  }

  void look(double azimuth, double elevation, std::initializer_list<double> shares) {
    if (std::abs(elevation) > kTurn / 4 || context_.cancelled()) return;
    const auto reached = reached_by(light_from(azimuth, elevation, 1.0).direction);
    for (const double share : shares) {
      if (share < 0.0 || share > 0.97) continue;
      const Agreement found = agreement(light_from(azimuth, elevation, share), reached);
      if (found.explained < kMinExplained || found.disagreement >= least_) continue;
      least_ = found.disagreement, azimuth_ = azimuth, elevation_ = elevation, share_ = share;
    }
  }

  /// Relative deviation of the albedos of a block from their mean; large ones count as one.
  static double disagreement(const std::array<float, kSlots>& albedo, std::size_t n) {
    float mean = 0.0f;
    for (std::size_t k = 0; k < n; ++k) mean += albedo[k] / float(n);
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double r = double(albedo[k] / mean - 1.0f) / kUsualDisagreement;
      sum += r * r / (1.0 + r * r);
    }
    return sum;
  }

  /// Means over the blocks and views that are not near the edge of a shadow.
  struct Agreement {
    double disagreement = 1e9;
    double explained = 0.0;  ///< by how much more they disagree under uniform light
  };

  Agreement agreement(const FixedLight& light, const Reached& reached) const {
    struct Sums {
      double even = 0.0, lit = 0.0, compared = 0.0, all = 0.0;
    };
    const auto parts =
        parallel_chunks<Sums>(blocks_.size(), 256, [&](std::size_t begin, std::size_t end) {
          Sums sums;
          for (std::size_t b = begin; b < end; ++b) {
            std::array<float, kSlots> even{}, albedo{};
            std::size_t n = 0;
            sums.all += double(blocks_[b].count);
            for (std::size_t k = 0; k < blocks_[b].count; ++k) {
              if (reached[b][k] == Lit::kUnsure) continue;
              even[n] = blocks_[b].luminance[k];
              albedo[n++] =
                  blocks_[b].luminance[k] / light_on(b, k, light, reached[b][k] == Lit::kYes);
            }
            if (n < 2) continue;
            sums.even += disagreement(even, n);
            sums.lit += disagreement(albedo, n);
            sums.compared += double(n);
          }
          return sums;
        });
    Sums sums;
    for (const Sums& part : parts)
      sums.even += part.even, sums.lit += part.lit, sums.compared += part.compared,
          sums.all += part.all;
    if (!(sums.compared > kMinCompared * sums.all)) return {};
    return {sums.lit / sums.compared, (sums.even - sums.lit) / sums.compared};
  }

  const LampScene& scene_;
  const std::vector<LightBlock> blocks_;
  const RunContext& context_;
  std::vector<std::vector<ViewSlot>> of_view_;
  double pixel_ = 0.0, step_angle_ = 0.0, step_share_ = 0.0;
  double least_ = 1e8, azimuth_ = 0.0, elevation_ = 0.0, share_ = 0.0;
};

/// Calls work(slot, view, lamp's view) for each slot of each block that uses a view.
template <class Work>
Result<> for_each_slot(const LampScene& scene, const FixedLight& light, const RunContext& context,
                       const Work& work) {
  const double pixel = pixel_of(scene.mesh, kMap_px);
  const auto slots = slots_by_view(scene.chosen, scene.rotation.size());
  parallel_for(slots.size(), 1, [&](std::size_t view) {
    if (slots[view].empty() || context.cancelled()) return;
    const LampView lamp(scene.mesh, scene.rotation[view].transpose() * light.direction, pixel);
    for (const ViewSlot& at : slots[view]) work(at, view, lamp);
  });
  return context.check();
}

}  // namespace

Vec3f rig_direction(double azimuth, double elevation) {
  return {float(std::cos(elevation) * std::sin(azimuth)), float(std::sin(elevation)),
          float(std::cos(elevation) * std::cos(azimuth))};
}

Result<TriangleMesh> coarse_caster(const TriangleMesh& mesh) {
  return simplify(mesh, {.triangles = kLookTriangles});
}

Result<FixedLight> solve_light(const LampScene& scene, const std::vector<Vec3f>& gains,
                               const std::optional<FixedLight>& near, const RunContext& context) {
  LampSearch search(scene, light_blocks(scene, gains), context);
  search.start(near);
  search.refine();
  TURNSCAN_TRY(context.check());
  return search.best();
}

Result<BlockLight> block_light(const LampScene& scene, const FixedLight& light,
                               const RunContext& context) {
  BlockLight out(scene.blocks.count());
  TURNSCAN_TRY(for_each_slot(
      scene, light, context, [&](const ViewSlot& at, std::size_t view, const LampView& lamp) {
        const int texel = scene.blocks.middle_texel(at.block);
        const Vec3f normal = scene.blocks.normal(at.block, texel);
        const Lit lit = lamp.lit(scene.blocks.surface(at.block, texel).position, normal);
        const float facing = (scene.rotation[view] * normal).dot(light.direction);
        out[at.block][at.slot] = lit == Lit::kUnsure ? -1.0f : light.on(facing, lit == Lit::kYes);
      }));
  return out;
}

Result<> mark_shadows(const LampScene& scene, const FixedLight& light, TexelSamples& samples,
                      const RunContext& context) {
  return for_each_slot(
      scene, light, context, [&](const ViewSlot& at, std::size_t, const LampView& lamp) {
        Sample* of_slot = samples.of(at.block, at.slot);
        for (int i = 0; i < kBlockTexels; ++i) {
          if (of_slot[i].valid == 0) continue;
          const Vec3f p = scene.blocks.surface(at.block, i).position;
          of_slot[i].lit = std::uint8_t(lamp.lit(p, scene.blocks.normal(at.block, i)));
        }
      });
}

}  // namespace turnscan::texture
