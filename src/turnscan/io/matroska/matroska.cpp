#include <algorithm>
#include <turnscan/io/matroska/indexer.hpp>
#include <turnscan/io/matroska/matroska.hpp>

namespace turnscan::matroska {

bool is_matroska_file(const std::filesystem::path& path) {
  const auto file = PositionedFile::open(path);
  if (!file) return false;
  const auto head = file->read(0, 4);
  return head && *head == "\x1a\x45\xdf\xa3";
}

Result<MatroskaFile> MatroskaFile::open(const std::filesystem::path& path,
                                        const RunContext& context) {
  TURNSCAN_ASSIGN(PositionedFile file, PositionedFile::open(path));
  MatroskaFile out(std::move(file));
  TURNSCAN_TRY(Indexer(out, context).run());
  return out;
}

std::string_view MatroskaFile::tag(std::string_view name) const {
  const auto found =
      std::find_if(tags_.begin(), tags_.end(), [&](const Tag& t) { return t.name == name; });
  return found == tags_.end() ? std::string_view() : std::string_view(found->value);
}

Result<std::string> MatroskaFile::read(const Block& block) const {
  TURNSCAN_ASSIGN(std::string bytes, file_.read(block.at, block.size));
  if (bytes.size() != block.size)
    return fail_at(path().string(), ErrorCode::kFormat,
                   "byte {}: the file has become shorter since it was opened", block.at);
  return bytes;
}

Result<std::string> MatroskaFile::read(const Attachment& attachment) const {
  if (attachment.size > kMaxHeaderBytes)
    return fail_at(path().string(), ErrorCode::kResourceLimit,
                   "byte {}: the attachment {} has {} bytes; at most {} are read", attachment.at,
                   attachment.name, attachment.size, kMaxHeaderBytes);
  return file_.read(attachment.at, attachment.size);
}

}  // namespace turnscan::matroska
