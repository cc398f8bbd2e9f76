#pragma once
// Matroska files (RFC 9559): metadata of the tracks, and the positions of their frames. Supports
// what recordings of depth sensors need: no lacing, no compression of whole tracks, no encryption.
// Cues are not needed and are ignored.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/matroska/ebml.hpp>
#include <vector>

namespace turnscan::matroska {

/// Position of the payload of one frame.
struct Block {
  std::int64_t time_ns = 0;
  std::uint64_t at = 0;
  std::uint32_t size = 0;
};

struct Track {
  std::uint64_t number = 0;
  std::uint64_t uid = 0;
  bool video = false;
  std::string name;
  std::string codec;                ///< e.g. "V_MS/VFW/FOURCC"
  std::string codec_private;        ///< e.g. a BITMAPINFOHEADER
  std::uint64_t frame_time_ns = 0;  ///< nominal; 0: not stated
  int width = 0, height = 0;        ///< pixels
  bool encoded = false;  ///< compressed or encrypted as a whole: frames are not readable directly
  std::vector<Block> blocks;  ///< of video tracks, in the order of the file
};

struct Tag {
  std::uint64_t track = 0;       ///< UID of the track that it describes; 0: none
  std::uint64_t attachment = 0;  ///< UID
  std::string name, value;
};

struct Attachment {
  std::uint64_t uid = 0;
  std::string name;
  std::uint64_t at = 0, size = 0;
};

/// An open file and its index; read() may be called from several threads at once. The index takes
/// 24 bytes per frame.
class MatroskaFile {
 public:
  /// Walks through the file from element to element, skipping frame data. A file that is truncated,
  /// or damaged after its first frame, is opened up to there: ended_early() says where and why. All
  /// frames are complete: they end within the file.
  /// Fails with kNotFound and kIo; with kFormat if it is not a Matroska file or damaged before its
  /// first frame; with kUnsupported for lacing; with kResourceLimit for more frames than a file of
  /// its length can have (file::ReadBudget), and with kCancelled.
  static Result<MatroskaFile> open(const std::filesystem::path& path,
                                   const RunContext& context = RunContext());

  const std::filesystem::path& path() const { return file_.path(); }
  const std::vector<Track>& tracks() const { return tracks_; }
  const std::vector<Tag>& tags() const { return tags_; }
  const std::vector<Attachment>& attachments() const { return attachments_; }
  const std::string& ended_early() const { return ended_early_; }  ///< empty: the file is complete

  /// The value of the first tag with this name; empty: there is none.
  std::string_view tag(std::string_view name) const;

  /// Fails with kIo, and with kFormat if the file has become shorter.
  Result<std::string> read(const Block& block) const;
  /// Also fails with kResourceLimit beyond 16 MiB.
  Result<std::string> read(const Attachment& attachment) const;

 private:
  friend class Indexer;
  explicit MatroskaFile(PositionedFile file) : file_(std::move(file)) {}

  PositionedFile file_;
  std::vector<Track> tracks_;
  std::vector<Tag> tags_;
  std::vector<Attachment> attachments_;
  std::string ended_early_;
};

/// Whether the file begins like a Matroska file; false also if it cannot be read.
bool is_matroska_file(const std::filesystem::path& path);

}  // namespace turnscan::matroska
