#include <algorithm>
#include <array>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/voxels/key_sort.hpp>
#include <utility>

namespace turnscan::voxels {

namespace {

constexpr std::uint32_t kRadixBits = 11;

constexpr std::size_t kDigits = std::size_t{1} << kRadixBits;
constexpr std::size_t kSlice = std::size_t{1} << 18;  // items that one thread counts and moves

/// Destination of each slice's items of each digit: after those of smaller digits, and of earlier
/// slices, which keeps the order of equal keys.
void to_places(std::vector<std::array<std::uint32_t, kDigits>>& counts) {
  std::uint32_t place = 0;
  for (std::size_t d = 0; d < kDigits; ++d)
    for (auto& of_slice : counts) place += std::exchange(of_slice[d], place);
}

}  // namespace

void sort_by_key(std::vector<KeyedItem>& items, std::uint64_t max_key) {
  std::vector<KeyedItem> other(items.size());
  std::vector<std::array<std::uint32_t, kDigits>> places((items.size() + kSlice - 1) / kSlice);
  for (std::uint32_t shift = 0; shift < 64 && (max_key >> shift) != 0; shift += kRadixBits) {
    const auto digit = [shift](const KeyedItem& item) {
      return std::size_t(item.key >> shift) & (kDigits - 1);
    };
    const auto each_of = [&](std::size_t slice, const auto& visit) {
      const std::size_t end = std::min(items.size(), (slice + 1) * kSlice);
      for (std::size_t i = slice * kSlice; i < end; ++i) visit(items[i], places[slice]);
    };
    parallel_for(places.size(), 1, [&](std::size_t slice) {
      places[slice].fill(0);
      each_of(slice, [&](const KeyedItem& item, auto& count) { ++count[digit(item)]; });
    });
    to_places(places);
    parallel_for(places.size(), 1, [&](std::size_t slice) {
      each_of(slice,
              [&](const KeyedItem& item, auto& place) { other[place[digit(item)]++] = item; });
    });
    items.swap(other);
  }
}

}  // namespace turnscan::voxels
