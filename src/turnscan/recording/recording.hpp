#pragma once
// A recording on disk: recording.json, frames.csv and one file per image or scan.
// docs/recording-format.md describes every field.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <vector>

namespace turnscan {

/// The schema version that is written; this and older ones are read.
inline constexpr int kRecordingSchema = 1;

/// What a capture program wants to keep about its settings (exposure, gain, ...): free text.
using CaptureSettings = std::map<std::string, std::string>;

/// Among them, where they are known, as utc_text(): when the first frame came, and when the
/// calibration of the turntable was made that was used.
inline constexpr const char* kStartedAt = "started_at";
inline constexpr const char* kTableCalibratedAt = "turntable_calibrated_at";

/// A recording opened for reading. It reads what is whole: a recording whose writer was killed
/// opens up to its last whole frame, and notes() says what is missing.
class Recording : public FrameSequence {
 public:
  /// Reads recording.json and frames.csv and looks at every file they name, but decodes none
  /// (except the last scan of points). Frames are sorted by index. A frame without its file, or
  /// with a truncated one, becomes FrameStatus::kDropped.
  /// Fails with kNotFound without a recording there, kUnsupported when the schema is newer, kFormat
  /// when recording.json is damaged or a line of frames.csv is wrong (two frames with one index, a
  /// number that is not finite, a sensor that does not exist, a file outside the folder).
  static Result<Recording> open(const std::filesystem::path& folder);

  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  /// Fails with kMissingData for a dropped frame.
  Result<Frame> read(std::size_t position) const override;

  /// What was found missing or out of order, one sentence each; empty when all is well.
  const std::vector<std::string>& notes() const { return notes_; }
  /// False when the writer was stopped before finish().
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

/// Of colour that its source has not packed as JPEG (Frame::color_jpeg), which stays as it is.
enum class ColorFileFormat { kPng, kJpeg };

/// Writes a recording frame by frame, so that a kill or a full disk at any moment leaves
/// everything up to the last whole frame readable. For one thread, but for write_files(). Holds a
/// lock on frames.csv while it exists, by which repair_recording() knows that it is at work.
class RecordingWriter {
 public:
  /// Makes the folder and its parents. Fails with kAlreadyExists when the folder has content, with
  /// kInvalidOption when the header has no sensor or a sensor that is not usable, and with kIo.
  static Result<RecordingWriter> create(const std::filesystem::path& folder,
                                        const SequenceHeader& header,
                                        const CaptureSettings& capture = {},
                                        ColorFileFormat color = ColorFileFormat::kPng);
  /// Goes on with a recording that is complete, behind its last frame; it counts as incomplete
  /// until finish(). Frames that it has are not touched. Fails with kNotFound without a recording
  /// there, with kInvalidOption when it is not complete, kUnsupported when another program wrote
  /// its table, kIo while another program writes it, and as parsing its files does.
  static Result<RecordingWriter> extend(const std::filesystem::path& folder,
                                        ColorFileFormat color = ColorFileFormat::kPng);
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  /// Leaves the recording as it is, marked incomplete unless finish() was called.
  ~RecordingWriter();

  /// Writes the frame's files, then its line. info.file is ignored: files are named after the
  /// index. A frame with status kDropped gets a line only. Fails with kInvalidOption when the index
  /// was used before or the frame does not fit its sensor, with kIo when the disk is full; what was
  /// appended before stays readable.
  Result<> append(const Frame& frame);

  /// The two halves of append(), for writers that encode on several threads. write_files() writes
  /// the frame's files and returns its line; it may run on several threads at once. append_line()
  /// makes the frame part of the recording. Both fail as append() does.
  Result<std::string> write_files(const Frame& frame) const;
  Result<> append_line(const FrameInfo& info, std::string_view line);

  /// What finish() writes about turntable and settings in place of what create() wrote: a speed, an
  /// outcome that was not known then. Throws std::invalid_argument when a sensor differs in number.
  void describe(const SequenceHeader& header, const CaptureSettings& capture);
  /// Marks the recording complete. Nothing can be appended afterwards. kSynced: first everything
  /// that was written to this file system has to be on the disk. (Until then frames survive the end
  /// of the process; what a power cut spares is up to the file system.)
  Result<> finish(Durability durability = Durability::kNamed);

 private:
  struct State;
  explicit RecordingWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;

  friend Result<> write_recording(const std::filesystem::path&, const FrameSequence&,
                                  const RunContext&);
};

/// Writes all frames of a sequence as a recording, reading and encoding on all cores; the bytes do
/// not depend on their number. The folder must not exist or be empty. On any failure, cancelling
/// included, everything that was made is removed.
Result<> write_recording(const std::filesystem::path& folder, const FrameSequence& sequence,
                         const RunContext& context);

}  // namespace turnscan
