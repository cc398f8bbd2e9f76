#pragma once
// Builds the index of a Matroska file in a single pass.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/matroska/matroska.hpp>

namespace turnscan::matroska {

/// Size limit of elements that are read as a whole: tracks, tags, attachments.
inline constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t(16) << 20;

class Indexer {
 public:
  Indexer(MatroskaFile& out, const RunContext& context)
      : out_(out), file_(out.file_), budget_(file_.size(), context) {}
  Result<> run();

 private:
  Result<> read_ebml_header();
  Result<> walk();
  Result<> enter(const Element& element);
  Result<> read_info(std::string_view payload);
  Result<> read_tracks(std::string_view payload);
  void read_track(std::string_view payload);
  void read_tags(std::string_view payload);
  Result<> read_attachments(const Element& element);
  Result<> read_block(const Element& element);
  Result<std::string> whole(const Element& element) const;
  Track* track_of(std::uint64_t number);
  /// The bytes at this offset, at least as many as an element's header needs if the file has them.
  Result<std::string_view> peek(std::uint64_t at);
  /// Ends the index at this offset; an error if there is no frame yet.
  Result<> stop(std::uint64_t at, std::string_view reason);

  MatroskaFile& out_;
  const PositionedFile& file_;
  const file::ReadBudget budget_;
  std::string window_;
  std::uint64_t window_at_ = 0;
  std::uint64_t time_scale_ns_ = 1000000;
  std::uint64_t cluster_time_ = 0;
  std::size_t frames_ = 0;
  bool stopped_ = false;
};

}  // namespace turnscan::matroska
