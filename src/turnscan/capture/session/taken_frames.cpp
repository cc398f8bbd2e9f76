#include <algorithm>
#include <turnscan/capture/session/taken_frames.hpp>

#include <turnscan/core/sequence_views.hpp>
namespace turnscan {

namespace {

Result<> take(FrameSource& source, std::size_t count, MemoryFrames& taken,
              const RunContext& context) {
  std::vector<std::size_t> counts(source.info().header.sensors.size(), 0);
  while (*std::min_element(counts.begin(), counts.end()) < count) {
    TURNSCAN_ASSIGN(Delivery delivery, source.next(kPatience_s, context));
    if (delivery.kind == Delivery::Kind::kEnd) break;
    if (delivery.kind == Delivery::Kind::kNothing)
      return fail(ErrorCode::kDeviceLost,
                  "{}: no frame came for {:.0f} s; check the cable and the power supply",
                  source.info().driver, kPatience_s);
    if (delivery.frame.info.status == FrameStatus::kOk) {
      ++counts[delivery.frame.info.sensor];
      context.advance();
    }
    taken.add(std::move(delivery.frame));
  }
  if (*std::max_element(counts.begin(), counts.end()) == 0)
    return fail(ErrorCode::kTooFewPoints, "{}: it ended without a frame; look at its input",
                source.info().driver);
  return {};
}

}  // namespace

Result<std::unique_ptr<FrameSequence>> take_frames(FrameSource& source, std::size_t count,
                                                   const RunContext& context) {
  context.begin_phase("take frames", count * source.info().header.sensors.size());
  auto taken = std::make_unique<MemoryFrames>(source.info().header);
  TURNSCAN_TRY(source.start());
  auto done = take(source, count, *taken, context);
  source.stop();
  if (!done) return tl::unexpected<Error>(std::move(done).error());
  return std::unique_ptr<FrameSequence>(std::move(taken));
}

}  // namespace turnscan
