#include <turnscan/capture/source/plugin_source.hpp>
#include <turnscan/capture/source/queued_source.hpp>

namespace turnscan::source {

namespace {

constexpr int kDefaultQueue = 60;

struct QueueOptions {
  int frames = kDefaultQueue;
};

OptionTable describe(QueueOptions& o) {
  OptionTable table;
  table.number("queue", o.frames, {1, 10000}, "Number of frames that may wait to be taken");
  return table;
}

/// Removes the parameters common to all sources from the URI.
Result<QueueOptions> take_queue(SourceUri& uri) {
  QueueOptions options;
  const OptionTable table = describe(options);
  SourceUri common{uri.scheme, {}, {}}, rest{uri.scheme, uri.address, {}};
  for (auto& parameter : uri.parameters)
    (table.find(parameter.first) != nullptr ? common : rest)
        .parameters.push_back(std::move(parameter));
  TURNSCAN_TRY(set_from_uri(common, table));
  uri = std::move(rest);
  return options;
}

Result<std::unique_ptr<Grabber>> open_grabber(const SourceUri& uri, const RunContext& context) {
  if (uri.scheme == "virtual") return open_virtual(uri, context);
  if (uri.scheme == "replay") return open_replay(uri, context);
  return open_plugin(uri, context);
}

}  // namespace

}  // namespace turnscan::source

namespace turnscan {

using namespace source;

Result<> FrameSource::lay_object(const Eigen::Matrix3d&, double) {
  return fail(ErrorCode::kUnsupported,
              "{}: the object has to be laid by hand; the program cannot do it", info().driver);
}

Result<> source::Grabber::lay_object(const Eigen::Matrix3d&, double) {
  return fail(ErrorCode::kUnsupported,
              "{}: the object has to be laid by hand; the program cannot do it", info().driver);
}

Result<std::unique_ptr<FrameSource>> open_source(const std::string& uri,
                                                 const RunContext& context) {
  TURNSCAN_ASSIGN(SourceUri parsed, parse_source_uri(uri));
  TURNSCAN_ASSIGN(const QueueOptions queue, take_queue(parsed));
  TURNSCAN_ASSIGN(std::unique_ptr<Grabber> grabber, open_grabber(parsed, context));
  return std::unique_ptr<FrameSource>(
      std::make_unique<QueuedSource>(std::move(grabber), std::size_t(queue.frames)));
}

}  // namespace turnscan
