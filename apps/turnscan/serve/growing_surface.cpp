#include "serve/growing_surface.hpp"

#include <algorithm>
#include <turnscan/workflow/page/page_model.hpp>

namespace turnscan::serve {

void GrowingSurface::clear() {
  const std::lock_guard lock(mutex_);
  shown_ = std::make_shared<const Shown>();
  since_ = number_;
}

void GrowingSurface::begin(const CaptureSetup& setup) {
  const std::lock_guard lock(mutex_);
  header_ = setup.header;
  finder_.emplace(setup.header, setup.options.speed_rad_s);
  motion_.reset();
}

void GrowingSurface::add(const Frame& frame) {
  const std::lock_guard lock(mutex_);
  if (!finder_) return;
  place_by(finder_->take(frame.info));
  if (!surface_) return;
  surface_->rest(Clock::now() - asked_ > kWanted);
  surface_->add(frame);
}

void GrowingSurface::take(const std::shared_ptr<const Calibration>& motion) {
  const std::lock_guard lock(mutex_);
  if (finder_) place_by(finder_->take(motion));
}

void GrowingSurface::place_by(const std::optional<LiveMotion>& motion) {
  if (!motion) return;
  motion_ = motion;
  if (surface_) surface_->set_motion(*motion);
}

void GrowingSurface::end() {
  std::unique_ptr<LiveSurface> ended;
  const std::lock_guard lock(mutex_);
  ended = std::move(surface_);
  header_.reset();
  finder_.reset();
}

std::shared_ptr<const GrowingSurface::Shown> GrowingSurface::newest() {
  std::optional<LiveSurface::Update> update;
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    asked_ = Clock::now();
    if (header_ && !surface_) {
      surface_ = std::make_unique<LiveSurface>(*header_);
      if (motion_) surface_->set_motion(*motion_);
    }
    if (surface_) update = surface_->take();
    if (!update) return shown_;
    number = ++number_;
  }
  PageObject object;
  object.mesh = std::move(update->mesh);
  auto shown = std::make_shared<const Shown>(
      Shown{number, update->frames, page::model_json({std::move(object)}, {})});
  const std::lock_guard lock(mutex_);
  // Of two that are made at once the later one stays, and none from before clear().
  if (number > std::max(shown_->number, since_)) shown_ = std::move(shown);
  return shown_;
}

}  // namespace turnscan::serve
