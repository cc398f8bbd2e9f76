#pragma once
// Writes a recording while frames arrive: the caller never waits for the disk.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <turnscan/core/option_table.hpp>
#include <turnscan/recording/recording.hpp>

namespace turnscan {

struct RecorderOptions {
  int queue_frames = 120;         ///< capacity of the encoding queue; further frames are dropped
  int encoders = 2;               ///< threads that encode and write
  double min_free_bytes = 256e6;  ///< stop before free disk space falls below this
  ColorFileFormat color = ColorFileFormat::kPng;
  int color_quality = 92;  ///< of JPEG images, 1 to 100
};
/// Options record-queue, record-threads, min-free, color-files, color-quality.
OptionTable describe(RecorderOptions& options);

/// Counted since create().
struct RecorderStatistics {
  std::uint64_t written = 0;            ///< complete frames with their line in frames.csv
  std::uint64_t dropped_by_source = 0;  ///< passed to put() as dropped
  std::uint64_t dropped_by_disk = 0;    ///< the queue was full: encoding or the disk is too slow
  std::uint64_t bytes = 0;              ///< of the files written
  std::size_t waiting = 0;              ///< frames currently in the queue
  std::size_t most_waiting = 0;         ///< maximum number of frames in the queue
  double most_wait_s = 0.0;             ///< maximum time from put() to the line
  double encode_cpu_s = 0.0;            ///< processor time of the encoding threads
  std::uint64_t free_bytes = 0;         ///< on the disk, when last checked
};

/// Frames pass through a bounded queue to threads that encode and write their files; lines are
/// appended in the order of put(). If the queue is full, the frame is replaced by a line that says
/// "dropped". Free space is checked before the start and about ten times a second.
class Recorder {
 public:
  /// Fails as RecordingWriter::create() does, and with kIo if the disk has less free space than
  /// min_free_bytes + expected_bytes.
  static Result<Recorder> create(const std::filesystem::path& folder, const SequenceHeader& header,
                                 const CaptureSettings& settings, const RecorderOptions& options,
                                 double expected_bytes = 0.0);
  /// Continues a complete recording; see RecordingWriter::extend(), whose errors it returns as
  /// well.
  static Result<Recorder> extend(const std::filesystem::path& folder,
                                 const RecorderOptions& options, double expected_bytes = 0.0,
                                 std::optional<std::uint32_t> resumed_at = {},
                                 bool was_finished = true);
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  /// Leaves the recording as it is, marked incomplete unless finish() was called. Queued frames are
  /// not written.
  ~Recorder();

  /// Never waits for the disk. info.index must increase from frame to frame. Fails with
  /// kInvalidOption if it does not, and with kIo once a file could not be written or the disk is
  /// nearly full; earlier frames stay readable, and finish() still completes the recording.
  Result<> put(Frame frame);

  /// Waits until the queue has room for one more frame, or put() would fail: for sources that can
  /// wait, so that none of their frames is dropped.
  void wait_for_room();

  /// Replaces the header and settings from create() that finish() writes into recording.json.
  void describe(const SequenceHeader& header, const CaptureSettings& settings);

  /// Waits until all frames are written, flushes them to the disk and marks the recording complete;
  /// also after a failure of put(), whose error it does not repeat. Fails with kIo.
  Result<> finish();

  RecorderStatistics statistics() const;

 private:
  struct State;
  static Result<Recorder> of(Result<RecordingWriter> writer, const std::filesystem::path& folder,
                             const RecorderOptions& options);
  explicit Recorder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Free bytes for this user on the file system of a folder, or of its nearest existing parent.
/// Fails with kIo.
Result<std::uint64_t> free_space(const std::filesystem::path& folder);

}  // namespace turnscan
