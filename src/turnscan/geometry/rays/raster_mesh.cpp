#include <turnscan/geometry/rays/raster_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <turnscan/core/morton.hpp>

namespace turnscan::sampling {

namespace {

constexpr int kCellBits = 10;  // along each axis: cells of a thousandth

/// Position along a Hilbert curve of kCellBits: unlike Morton's it has no jumps, so that
/// consecutive elements are compact (Skilling 2004, Programming the Hilbert curve).
std::uint32_t hilbert_code(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t kTop = 1u << (kCellBits - 1);
  for (std::uint32_t bit = kTop; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : x) {
      if ((axis & bit) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t swapped = (x[0] ^ axis) & below;
        x[0] ^= swapped;
        axis ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = kTop; bit > 1; bit >>= 1)
    if ((x[2] & bit) != 0) flip ^= bit - 1;
  return static_cast<std::uint32_t>(morton_code(x[2] ^ flip, x[1] ^ flip, x[0] ^ flip));
}

const float* corner_of(const ObjectView& object, std::uint32_t triangle, int corner) {
  return object.vertices +
         3 * std::size_t(object.indices[3 * std::size_t(triangle) + std::size_t(corner)]);
}

struct Bounds {
  std::array<float, 3> low{}, high{};

  Bounds() {
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
  }
  void add(const float* p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  void add(const Bounds& other) {
    add(other.low.data());
    add(other.high.data());
  }
};

/// Blocks of kLanes boxes, in the layout of GroupBoxes.
std::vector<float> blocks_of(const std::vector<Bounds>& boxes) {
  constexpr std::size_t kWidth = kLanes;
  std::vector<float> blocks((boxes.size() + kWidth - 1) / kWidth * kWidth * 6);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    float* block = blocks.data() + i / kWidth * kWidth * 6 + i % kWidth;
    for (std::size_t k = 0; k < 3; ++k) {
      const float centre = 0.5f * boxes[i].low[k] + 0.5f * boxes[i].high[k];
      block[k * kWidth] = centre;
      block[(3 + k) * kWidth] = std::max(boxes[i].high[k] - centre, centre - boxes[i].low[k]);
    }
  }
  return blocks;
}

std::vector<Bounds> united(const std::vector<Bounds>& boxes) {
  constexpr std::size_t kWidth = kLanes;
  std::vector<Bounds> out((boxes.size() + kWidth - 1) / kWidth);
  for (std::size_t i = 0; i < boxes.size(); ++i) out[i / kWidth].add(boxes[i]);
  return out;
}

struct Place {
  std::uint32_t code = 0;
  TriangleName name;
};

std::vector<Place> places_of(const std::vector<ObjectView>& objects) {
  Bounds all;
  std::size_t count = 0;
  for (const ObjectView& object : objects) {
    count += object.triangle_count;
    for (std::uint32_t v = 0; v < object.vertex_count; ++v)
      all.add(object.vertices + 3 * std::size_t(v));
  }
  std::array<float, 3> cells{};
  constexpr float kCells = float((1 << kCellBits) - 1);
  for (std::size_t k = 0; k < 3; ++k)
    cells[k] = all.high[k] > all.low[k] ? kCells / (all.high[k] - all.low[k]) : 0.0f;
  std::vector<Place> places;
  places.reserve(count);
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    for (std::uint32_t t = 0; t < objects[o].triangle_count; ++t) {
      const float *a = corner_of(objects[o], t, 0), *b = corner_of(objects[o], t, 1),
                  *c = corner_of(objects[o], t, 2);
      std::array<std::uint32_t, 3> cell{};
      for (std::size_t k = 0; k < 3; ++k) {
        const float middle = (a[k] + b[k] + c[k]) * (1.0f / 3.0f);
        const float place = (middle - all.low[k]) * cells[k];
        // Coordinates near the limits of float overflow here: they are assigned to the first cell.
        cell[k] = place > 0.0f ? static_cast<std::uint32_t>(std::min(place, kCells)) : 0;
      }
      places.push_back({hilbert_code(cell), {o, t}});
    }
  }
  return places;
}

/// Sorts by code; equal codes keep the given order.
void sort_places(std::vector<Place>& places) {
  constexpr int kDigit = 10;
  constexpr std::size_t kValues = std::size_t{1} << kDigit;
  std::vector<Place> other(places.size());
  for (int shift = 0; shift < 3 * kCellBits; shift += kDigit) {
    std::array<std::size_t, kValues + 1> start{};
    for (const Place& p : places) ++start[(p.code >> shift & (kValues - 1)) + 1];
    for (std::size_t d = 1; d <= kValues; ++d) start[d] += start[d - 1];
    for (const Place& p : places) other[start[p.code >> shift & (kValues - 1)]++] = p;
    places.swap(other);
  }
}

}  // namespace

RasterMesh RasterMesh::build(const std::vector<ObjectView>& objects) {
  std::vector<Place> places = places_of(objects);
  sort_places(places);
  RasterMesh mesh;
  constexpr std::size_t kWidth = kLanes;
  std::vector<Bounds> boxes((places.size() + kWidth - 1) / kWidth);
  mesh.names_.resize(boxes.size() * kWidth);
  mesh.corners_.resize(boxes.size() * kWidth * 9);
  for (std::size_t slot = 0; slot < mesh.names_.size(); ++slot) {
    const TriangleName name = places[std::min(slot, places.size() - 1)].name;
    mesh.names_[slot] = name;
    float* group = mesh.corners_.data() + slot / kWidth * kWidth * 9 + slot % kWidth;
    for (int corner = 0; corner < 3; ++corner) {
      const float* p = corner_of(objects[name.object], name.triangle, corner);
      boxes[slot / kWidth].add(p);
      for (int k = 0; k < 3; ++k) group[std::size_t(3 * corner + k) * kWidth] = p[k];
    }
  }
  for (std::size_t level = 0; level < mesh.bounds_.size(); ++level) {
    mesh.bounds_[level] = blocks_of(boxes);
    mesh.counts_[level] = static_cast<int>(boxes.size());
    boxes = united(boxes);
  }
  return mesh;
}

Clusters RasterMesh::view() const {
  Clusters view{corners_.data(), names_.data(), {}};
  for (std::size_t level = 0; level < bounds_.size(); ++level)
    view.levels[level] = {bounds_[level].data(), counts_[level]};
  return view;
}

}  // namespace turnscan::sampling
