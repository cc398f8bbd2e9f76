#include <turnscan/reconstruction/views/view_store.hpp>

namespace turnscan::views {

namespace {

std::size_t bytes_of(const DepthView& view) {
  return view.pixels.size() * sizeof(view.pixels[0]) + view.colors.size() * sizeof(Rgb);
}

}  // namespace

void ViewStore::add(DepthView view, std::uint32_t sensor) {
  if (seen_.size() <= sensor) seen_.resize(std::size_t(sensor) + 1, 0);
  const std::uint32_t number = seen_[sensor]++;
  if (number % stride_ != 0) return;
  bytes_ += bytes_of(view);
  views_.push_back(std::move(view));
  key_.emplace_back(sensor, number);
  while (views_.size() > kMaxViews || (bytes_ > kMaxBytes && views_.size() > kFewViews)) thin();
}

void ViewStore::thin() {
  stride_ *= 2;
  std::size_t kept = 0;
  bytes_ = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (key_[v].second % stride_ != 0) continue;
    bytes_ += bytes_of(views_[v]);
    if (kept != v) views_[kept] = std::move(views_[v]);
    key_[kept++] = key_[v];
  }
  views_.resize(kept);
  key_.resize(kept);
}

}  // namespace turnscan::views
