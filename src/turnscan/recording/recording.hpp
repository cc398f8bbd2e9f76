#pragma once
// A recording on disk: recording.json, frames.csv and one file per image or scan.
// docs/reference/recording-format.md describes every field.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <vector>

namespace turnscan {

/// The schema version that is written; this and older ones can be read.
inline constexpr int kRecordingSchema = 1;

/// Free text that a capture program stores about its settings (exposure, gain, ...).
using CaptureSettings = std::map<std::string, std::string>;

/// Keys among them, present if known, with values as utc_text(): when the first frame arrived, and
/// when the turntable calibration in use was made.
inline constexpr const char* kStartedAt = "started_at";
inline constexpr const char* kTableCalibratedAt = "turntable_calibrated_at";

/// A recording opened for reading. Reads what is complete: a recording whose writer was killed
/// opens up to its last complete frame, and notes() lists what is missing.
class Recording : public FrameSequence {
 public:
  /// Reads recording.json and frames.csv and checks every file that they name, but decodes none
  /// (except the last scan of points). Frames are sorted by index. A frame without its file, or
  /// with a truncated one, becomes FrameStatus::kDropped.
  /// Fails with kNotFound if there is no recording, with kUnsupported if the schema is newer, with
  /// kFormat if recording.json is damaged or a line of frames.csv is wrong (two frames with one
  /// index, a number that is not finite, a sensor that does not exist, a file outside the folder),
  /// and with kCancelled.
  static Result<Recording> open(const std::filesystem::path& folder,
                                const RunContext& context = RunContext());

  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  /// Fails with kMissingData for a dropped frame.
  Result<Frame> read(std::size_t position) const override;

  /// What was found missing or out of order, one sentence each; empty if there are no defects.
  const std::vector<std::string>& notes() const { return notes_; }
  /// False if the writer was stopped before finish().
  bool complete() const { return complete_; }
  const CaptureSettings& capture_settings() const { return capture_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  SequenceHeader header_;
  CaptureSettings capture_;
  std::vector<FrameInfo> frames_;
  std::vector<std::string> color_files_;  ///< per frame, relative; empty: none
  std::vector<std::string> notes_;
  bool complete_ = true;
};

/// Format of colour images that their source has not encoded as JPEG (Frame::color_jpeg); those are
/// stored unchanged.
enum class ColorFileFormat { kPng, kJpeg };

/// Writes a recording frame by frame, so that a kill or a full disk at any moment leaves everything
/// up to the last complete frame readable. For one thread, except write_files(). Holds a lock on
/// frames.csv while it exists, by which repair_recording() detects an active writer.
class RecordingWriter {
 public:
  /// Creates the folder and its parents. Fails with kAlreadyExists if the folder has content, with
  /// kInvalidOption if the header has no sensor or a sensor that is not usable, and with kIo.
  static Result<RecordingWriter> create(const std::filesystem::path& folder,
                                        const SequenceHeader& header,
                                        const CaptureSettings& capture = {},
                                        ColorFileFormat color = ColorFileFormat::kPng);
  /// Appends to a complete recording, after its last frame; it counts as incomplete until finish().
  /// Existing frames are not modified. Fails with kNotFound if there is no recording, with
  /// kInvalidOption if it is not complete, with kUnsupported if another program wrote its table,
  /// with kIo while another program writes it, and as parsing its files does.
  /// resumed_at: index of the first frame of a new stretch (FrameInfo::stretch). was_finished: else
  /// it counts as one that its writer never finished, as before it was repaired.
  static Result<RecordingWriter> extend(const std::filesystem::path& folder,
                                        ColorFileFormat color = ColorFileFormat::kPng,
                                        std::optional<std::uint32_t> resumed_at = {},
                                        bool was_finished = true);
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  /// Leaves the recording as it is, marked incomplete unless finish() was called.
  ~RecordingWriter();

  /// Writes the frame's files, then its line. info.file is ignored: files are named after the
  /// index. A frame with status kDropped gets only a line. Fails with kInvalidOption if the index
  /// was used before or the frame does not match its sensor, with kIo if the disk is full; frames
  /// appended before remain readable.
  Result<> append(const Frame& frame);

  /// The two halves of append(), for writers that encode on several threads. write_files() writes
  /// the frame's files and returns its line; it may run on several threads at once. append_line()
  /// makes the frame part of the recording. Both fail as append() does.
  Result<std::string> write_files(const Frame& frame) const;
  Result<> append_line(const FrameInfo& info, std::string_view line);

  /// Replaces what create() wrote about turntable and settings by values known only now, such as a
  /// speed or an outcome; finish() writes them. Throws std::invalid_argument if the number of
  /// sensors differs.
  void describe(const SequenceHeader& header, const CaptureSettings& capture);
  /// Marks the recording complete. Nothing can be appended afterwards. kSynced: everything written
  /// to this file system is first flushed to the disk. (Until then frames survive the end of the
  /// process; what survives a power cut depends on the file system.)
  Result<> finish(Durability durability = Durability::kNamed);

 private:
  struct State;
  explicit RecordingWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;

  friend Result<> write_recording(const std::filesystem::path&, const FrameSequence&,
                                  const RunContext&);
};

/// Writes all frames of a sequence as a recording, reading and encoding on all cores; the bytes do
/// not depend on their number. The folder must not exist or must be empty. On any failure,
/// including cancellation, everything that was created is removed.
Result<> write_recording(const std::filesystem::path& folder, const FrameSequence& sequence,
                         const RunContext& context);

}  // namespace turnscan
