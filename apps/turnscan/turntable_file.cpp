#include "turntable_file.hpp"

#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/json_fields.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan::cli {

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

class Retabled : public FrameSequence {
 public:
  Retabled(const FrameSequence& sequence, SequenceHeader header)
      : sequence_(sequence), header_(std::move(header)) {}
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return sequence_.frames(); }
  Result<Frame> read(std::size_t position) const override { return sequence_.read(position); }

 private:
  const FrameSequence& sequence_;
  SequenceHeader header_;
};

Result<TurntableInfo> parse_turntable(const std::string& text) {
  TURNSCAN_ASSIGN(const Json json, parse_json(text));
  TURNSCAN_ASSIGN(JsonObject object, JsonObject::from(json, ""));
  if (object.has("turntable")) {
    TURNSCAN_ASSIGN(object, object.object("turntable"));
  }
  TurntableInfo table;
  TURNSCAN_ASSIGN(table.axis, object.vector("axis"));
  TURNSCAN_ASSIGN(table.center_m, object.vector("center_m"));
  TURNSCAN_ASSIGN(table.radius_m, object.optional_number("radius_m"));
  TURNSCAN_ASSIGN(table.speed_rad_s, object.optional_number("speed_rad_s"));
  if (!(table.axis.norm() > 1e-6) || (table.radius_m && !(*table.radius_m > 0.0)))
    return fail(ErrorCode::kFormat, "the axis has no length or the radius is not positive");
  table.axis.normalize();
  TURNSCAN_TRY(table_from_sensor(table));
  return table;
}

}  // namespace

Result<std::unique_ptr<FrameSequence>> with_turntable(const FrameSequence& sequence,
                                                      const std::string& path) {
  SequenceHeader header = sequence.header();
  if (!path.empty()) {
    TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
    auto turntable = parse_turntable(text);
    if (!turntable)
      return fail_at(path, turntable.error().code,
                     "not a turntable: {}; write it as in docs/command-line.md",
                     turntable.error().message);
    header.turntable = *turntable;
    if (!header.sensors.empty()) header.sensors[0].T_table_sensor.reset();
  }
  return std::make_unique<Retabled>(sequence, std::move(header));
}

}  // namespace turnscan::cli
