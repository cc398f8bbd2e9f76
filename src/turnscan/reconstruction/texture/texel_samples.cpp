#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

namespace {

constexpr float kMinViewCosine = 0.12f;
constexpr float kNearRim = 0.02f;  // weight of a point near a rim
constexpr std::size_t kViewsAtOnce = 8;
constexpr int kMaxSubsamples = 4;
// Ranked by how well they see a block. In addition to the best few, views farther apart are chosen:
// the best views see a highlight, which must not be in most of the compared ones.
constexpr std::size_t kRanked = 16;
constexpr std::array<std::size_t, kSlots> kTakenRanks{0, 1, 2, 3, 5, 8, 11, 14};

/// Weights of four consecutive pixels for a position at a fraction t after the second (Keys 1981, a
/// = -1/2).
std::array<float, 4> cubic(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {-0.5f * t3 + t2 - 0.5f * t, 1.5f * t3 - 2.5f * t2 + 1.0f,
          -1.5f * t3 + 2.0f * t2 + 0.5f * t, 0.5f * t3 - 0.5f * t2};
}

/// As pixel_at(), but preserves more detail between the pixels' centres.
Vec3f sharp_pixel_at(const ColorImage& image, float u, float v) {
  const int x = int(u), y = int(v);
  const auto wx = cubic(u - float(x)), wy = cubic(v - float(y));
  Vec3f sum = Vec3f::Zero();
  for (int row = 0; row < 4; ++row) {
    const Rgb* from =
        &image.pixels[std::size_t(y + row - 1) * std::size_t(image.width) + std::size_t(x - 1)];
    Vec3f line = Vec3f::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      line += wx[i] * Vec3f(float(from[i].r), float(from[i].g), float(from[i].b));
    sum += wy[std::size_t(row)] * line;
  }
  return sum;
}

/// A few texels that represent a block.
struct BlockProbe {
  std::array<Vec3f, 3> position;
  Vec3f normal = Vec3f::Zero();
};

BlockProbe probe_of(const TexelBlocks& blocks, std::size_t block) {
  std::array<int, kBlockTexels> covered{};
  int n = 0;
  for (int i = 0; i < kBlockTexels; ++i)
    if (blocks.triangle(block, i) != kNoTriangle) covered[std::size_t(n++)] = i;
  BlockProbe probe;
  const std::array<int, 3> which{covered[0], covered[std::size_t(n / 2)],
                                 covered[std::size_t(n - 1)]};
  for (std::size_t k = 0; k < 3; ++k) {
    probe.position[k] = blocks.surface(block, which[k]).position;
    probe.normal += blocks.normal(block, which[k]);
  }
  probe.normal.normalize();
  return probe;
}

/// Pixels squared per area of surface, times the square of the cosine of incidence: once for the
/// foreshortening, once because oblique views are less reliable.
float quality_of(const BlockProbe& probe, const ColorView& view, const DrawnMesh& drawn) {
  const Vec3f to_eye = view.eye() - probe.position[1];
  const float distance = to_eye.norm();
  const float cosine = probe.normal.dot(to_eye) / distance;
  if (!(cosine > kMinViewCosine)) return 0.0f;
  float seen = 0.0f;
  for (const Vec3f& p : probe.position) {
    const Shown shown = drawn.shows(view.project(p));
    seen += shown == Shown::kWell ? 1.0f : shown == Shown::kNearRim ? kNearRim : 0.0f;
  }
  const float scale = view.focal_px() / distance;
  return scale * scale * cosine * cosine * seen / 3.0f;
}

/// The best views so far, in descending order.
struct Ranking {
  std::array<std::uint16_t, kRanked> view;
  std::array<float, kRanked> quality{};
  Ranking() { view.fill(kNoView); }
  void add(std::uint16_t which, float value) {
    if (!(value > quality[kRanked - 1])) return;
    std::size_t at = kRanked - 1;
    for (; at > 0 && value > quality[at - 1]; --at) {
      view[at] = view[at - 1];
      quality[at] = quality[at - 1];
    }
    view[at] = which;
    quality[at] = value;
  }
};

/// The last ones move up if fewer views see the block, so that no slot is wasted.
std::array<std::size_t, kSlots> taken_ranks(const Ranking& ranking) {
  std::array<std::size_t, kSlots> out = kTakenRanks;
  const auto end = std::find(ranking.view.begin(), ranking.view.end(), kNoView);
  const auto n = std::size_t(end - ranking.view.begin());
  for (std::size_t k = kSlots; k-- > 0;)
    out[k] = std::max(k, std::min(out[k], n + k > kSlots ? n + k - kSlots : 0));
  return out;
}

/// Ratio of the energy of the second derivatives to that of the first ones, inside the object:
/// decreases with blur, independently of the content.
double sharpness_of(const ColorImage& image, const DrawnMesh& drawn) {
  double first = 0.0, second = 0.0;
  for (int y = 2; y + 2 < drawn.height(); y += 2) {
    for (int x = 2; x + 2 < drawn.width(); ++x) {
      if (!drawn.covered(x - 2, y) || !drawn.covered(x + 2, y)) continue;
      const int row = drawn.top() + y, column = drawn.left() + x;
      const auto g = [&](int dx) { return double(image.at(column + dx, row).g); };
      const double d = g(1) - g(-1), dd = g(2) - 2.0 * g(0) + g(-2);
      first += d * d;
      second += dd * dd;
    }
  }
  return first > 0.0 ? second / first : 0.0;
}

/// Maximum number of pixels by which the view's image moves between adjacent texels.
int subsamples(const TexelBlocks::Surface& s, const ColorView& view) {
  const Projection a = view.project(s.position), b = view.project(s.position + s.right),
                   c = view.project(s.position + s.down);
  if (!(a.z > 0.0f && b.z > 0.0f && c.z > 0.0f)) return 1;
  const float step = std::max(std::hypot(b.u - a.u, b.v - a.v), std::hypot(c.u - a.u, c.v - a.v));
  return std::clamp(int(step + 0.5f), 1, kMaxSubsamples);
}

class BlockSampler {
 public:
  BlockSampler(const TexelBlocks& blocks, const ColorView& view, const DrawnMesh& drawn,
               const ColorImage& image)
      : blocks_(blocks), view_(view), drawn_(drawn), image_(image) {}

  void sample(std::size_t block, Sample* out) const {
    int side = 0;
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks_.triangle(block, i) == kNoTriangle) continue;
      const TexelBlocks::Surface s = blocks_.surface(block, i);
      const Projection p = view_.project(s.position);
      const Shown shown = drawn_.shows(p);
      if (shown == Shown::kNot || !within(p)) continue;
      if (side == 0) side = subsamples(s, view_);
      const Vec3f color = side == 1 ? sharp_pixel_at(image_, p.u, p.v) : mean(s, side);
      const auto byte = [](float v) { return std::uint8_t(std::clamp(v + 0.5f, 0.0f, 255.0f)); };
      out[i].r = byte(color.x()), out[i].g = byte(color.y()), out[i].b = byte(color.z());
      out[i].valid = shown == Shown::kWell ? Sample::kWell : Sample::kNearRim;
    }
  }

 private:
  bool within(const Projection& p) const {
    return p.u >= 1.0f && p.v >= 1.0f && p.u < float(image_.width - 2) &&
           p.v < float(image_.height - 2);
  }

  Vec3f mean(const TexelBlocks::Surface& s, int side) const {
    Vec3f sum = Vec3f::Zero();
    int n = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float fx = (float(x) + 0.5f) / float(side) - 0.5f;
        const float fy = (float(y) + 0.5f) / float(side) - 0.5f;
        const Projection p = view_.project(s.position + fx * s.right + fy * s.down);
        if (!(p.z > 0.0f) || !within(p)) continue;
        sum += pixel_at(image_, p.u, p.v);
        ++n;
      }
    return n > 0 ? Vec3f(sum / float(n)) : sum;
  }

  const TexelBlocks& blocks_;
  const ColorView& view_;
  const DrawnMesh& drawn_;
  const ColorImage& image_;
};

}  // namespace

Vec3f pixel_at(const ColorImage& image, float u, float v) {
  const int x = int(u), y = int(v);
  const float fx = u - float(x), fy = v - float(y);
  const Rgb* above = &image.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
  const Rgb* below = above + image.width;
  const auto mix = [&](std::uint8_t Rgb::*channel) {
    const float top =
        float(above[0].*channel) + fx * (float(above[1].*channel) - float(above[0].*channel));
    const float low =
        float(below[0].*channel) + fx * (float(below[1].*channel) - float(below[0].*channel));
    return top + fy * (low - top);
  };
  return {mix(&Rgb::r), mix(&Rgb::g), mix(&Rgb::b)};
}

Result<ColorImage> image_of(const FrameSequence& sequence, const ColorView& view) {
  TURNSCAN_ASSIGN(Frame frame, sequence.read(view.position));
  if (frame.color.empty() ||
      (frame.color.width == view.camera.width && frame.color.height == view.camera.height))
    return std::move(frame.color);
  return fail(ErrorCode::kFormat,
              "frame {}: its colour image has {} x {} pixels, but its camera {} x {}; correct the "
              "camera in the recording",
              frame.info.index, frame.color.width, frame.color.height, view.camera.width,
              view.camera.height);
}

Result<ChosenViews> choose_views(const TriangleMesh& mesh, const TexelBlocks& blocks,
                                 const std::vector<ColorView>& views, const RunContext& context) {
  std::vector<BlockProbe> probes(blocks.count());
  parallel_for(probes.size(), 512, [&](std::size_t b) { probes[b] = probe_of(blocks, b); });
  std::vector<Ranking> rankings(blocks.count());
  for (std::size_t begin = 0; begin < views.size(); begin += kViewsAtOnce) {
    const std::size_t end = std::min(begin + kViewsAtOnce, views.size());
    std::vector<std::optional<DrawnMesh>> drawn(end - begin);
    parallel_for(drawn.size(), 1, [&](std::size_t i) { drawn[i].emplace(views[begin + i], mesh); });
    TURNSCAN_TRY(context.check());
    parallel_for(probes.size(), 512, [&](std::size_t b) {
      for (std::size_t i = 0; i < drawn.size(); ++i)
        if (!drawn[i]->empty())
          rankings[b].add(std::uint16_t(begin + i),
                          quality_of(probes[b], views[begin + i], *drawn[i]));
    });
    context.advance(end - begin);
  }
  ChosenViews out;
  out.view.resize(blocks.count());
  out.weight.resize(blocks.count());
  std::vector<float> best;
  for (std::size_t b = 0; b < rankings.size(); ++b) {
    const Ranking& ranking = rankings[b];
    if (b % 16 == 0 && ranking.quality[0] > 0.0f) best.push_back(std::sqrt(ranking.quality[0]));
    const float other = ranking.quality[kRanked - 1];
    const auto ranks = taken_ranks(ranking);
    for (std::size_t k = 0; k < kSlots; ++k) {
      out.view[b][k] = ranking.view[ranks[k]];
      const float q = ranking.quality[ranks[k]];
      out.weight[b][k] = q * q * (q * q - other * other + 1e-6f * q * q);
    }
  }
  out.pixels_per_m = median(best);
  return out;
}

std::vector<std::vector<ViewSlot>> slots_by_view(const ChosenViews& chosen, std::size_t views) {
  std::vector<std::vector<ViewSlot>> out(views);
  for (std::size_t b = 0; b < chosen.view.size(); ++b)
    for (std::size_t k = 0; k < kSlots; ++k)
      if (chosen.view[b][k] != kNoView)
        out[chosen.view[b][k]].push_back({std::uint32_t(b), std::uint8_t(k)});
  return out;
}

Result<TexelSamples> sample_views(const FrameSequence& sequence, const TriangleMesh& mesh,
                                  const TexelBlocks& blocks, const std::vector<ColorView>& views,
                                  const ChosenViews& chosen, const RunContext& context) {
  TexelSamples out;
  out.samples.resize(blocks.count() * kSlots * kBlockTexels);
  std::vector<double> sharpness(views.size(), 0.0);
  const auto slots = slots_by_view(chosen, views.size());
  TURNSCAN_TRY(parallel_for(views.size(), 1, context, [&](std::size_t i) -> Result<> {
    if (slots[i].empty()) return {};
    TURNSCAN_ASSIGN(const ColorImage image, image_of(sequence, views[i]));
    context.advance();
    if (image.empty()) return {};
    const DrawnMesh drawn(views[i], mesh);
    if (drawn.empty()) return {};
    sharpness[i] = sharpness_of(image, drawn);
    const BlockSampler sampler(blocks, views[i], drawn, image);
    for (const ViewSlot& at : slots[i]) sampler.sample(at.block, out.of(at.block, at.slot));
    return {};
  }));
  std::vector<double> known;
  for (const double s : sharpness)
    if (s > 0.0) known.push_back(s);
  const double usual = median(known, 1.0);
  for (const double s : sharpness) out.sharpness.push_back(float(s / usual));
  return out;
}

}  // namespace turnscan::texture
