#pragma once
// recording.json as text.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/recording/recording.hpp>

namespace turnscan::recording_format {

inline constexpr std::uint64_t kMaxDescriptionBytes = std::uint64_t(4) << 20;

struct RecordingDescription {
  SequenceHeader header;
  CaptureSettings capture;
  bool complete = false;
  std::optional<std::uint32_t> frame_count;  ///< when it was last complete
  std::vector<std::uint32_t> resumed_at;     ///< indices of the frames that begin a new stretch
};

/// Fails with kUnsupported if the schema is newer, with kFormat if a field is missing or wrong.
/// Unknown fields are ignored.
Result<RecordingDescription> parse_recording_json(std::string_view text);

std::string recording_json(const RecordingDescription& description);

/// The fields at the beginning of every sensor's description: kind, model, and a camera's
/// intrinsics and depth.
text::OrderedJson sensor_kind_json(const SensorInfo& sensor);

/// The object "turntable", SI units.
text::OrderedJson turntable_json(const TurntableInfo& table);

/// Fails with kInvalidOption, naming the sensor, unless all values of the header are usable.
Result<> check_header(const SequenceHeader& header);

}  // namespace turnscan::recording_format
