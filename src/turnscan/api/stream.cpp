#include <turnscan/api/named_options.hpp>
#include <turnscan/api/reconstructed_scan.hpp>
#include <turnscan/api/stream.hpp>
#include <turnscan/reconstruction/stream.hpp>

namespace turnscan {

struct Stream::Impl {
  ReconstructionStream stream;
  ReconstructOptions options;
};

Stream::Stream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Stream::Stream(Stream&&) noexcept = default;
Stream& Stream::operator=(Stream&&) noexcept = default;
Stream::~Stream() = default;

Result<Stream> Stream::create(const SequenceHeader& header, const Options& options) {
  ReconstructOptions chosen;
  TURNSCAN_TRY(api::set_fields(describe(chosen), options));
  TURNSCAN_ASSIGN(ReconstructionStream stream, ReconstructionStream::create(header, chosen));
  return Stream(std::make_unique<Impl>(Impl{std::move(stream), chosen}));
}

Result<> Stream::add(const Frame& frame, const RunContext& context) {
  return add(std::span(&frame, 1), context);
}

Result<> Stream::add(std::span<const Frame> frames, const RunContext& context) {
  std::vector<FrameInfo> infos;
  for (const Frame& frame : frames) infos.push_back(frame.info);
  return impl_->stream.add(
      infos, [&](std::size_t i) -> Result<Frame> { return frames[i]; }, context);
}

Result<TriangleMesh> Stream::preview(const RunContext& context) const {
  return impl_->stream.preview(context);
}

Result<ReconstructedScan> Stream::finish(const RunContext& context) {
  auto made = std::make_shared<ReconstructedScan::Impl>();
  TURNSCAN_ASSIGN(made->run.reconstruction, impl_->stream.finish({}, context));
  made->options = impl_->options;
  return ReconstructedScan(std::move(made));
}

}  // namespace turnscan
