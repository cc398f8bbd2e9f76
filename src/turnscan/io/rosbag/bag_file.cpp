#include <zstd.h>

#include <algorithm>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/rosbag/bag_part.hpp>
#include <turnscan/io/rosbag/chunk_codec.hpp>

namespace turnscan::rosbag {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kZstdMagic = "\x28\xb5\x2f\xfd";
constexpr std::size_t kBegin = 64;  // longer than any magic

PartResult open_part(const fs::path& path, std::uint32_t number, BagIndex& index) {
  TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(path));
  TURNSCAN_ASSIGN(const std::string begin,
                  file.read(0, std::min<std::uint64_t>(file.size(), kBegin)));
  if (begin.starts_with(kRos1Magic)) return open_ros1_part(std::move(file), number, index);
  if (begin.starts_with(kMcapMagic)) return open_mcap_part(std::move(file), number, index);
  if (begin.starts_with(kSqliteMagic)) return open_sqlite_part(path, number, index);
  if (begin.starts_with(kZstdMagic))
    return fail(ErrorCode::kUnsupported, "the whole file is compressed; unpack it with unzstd");
  return fail(ErrorCode::kFormat, "this is no ROS bag; give one");
}

/// A message that rosbag2 compressed (compression_mode: message).
Result<std::string> unpacked_message(std::string_view bytes, const file::ReadBudget* charged) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR)
    return fail(ErrorCode::kFormat, "a compressed message does not say its size");
  if (size > Bag::kMaxMessageBytes)
    return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                size);
  if (charged != nullptr) TURNSCAN_TRY(charged->unpack(size));
  return unpack(Packing::kZstd, bytes, std::size_t(size));
}

/// The files that rosbag2's metadata.yaml lists ("relative_file_paths:", then "- NAME" a line); of
/// a folder without it, which a recorder that was killed leaves, the only one that is there.
Result<std::vector<fs::path>> parts_of(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code error;
  constexpr std::size_t kMaxMetadata = 16U << 20;
  constexpr std::size_t kMaxParts = 1000;  // each is held open
  bool listed = false;
  const fs::path list = folder / "metadata.yaml";
  if (fs::exists(list, error)) {
    TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(list));
    TURNSCAN_ASSIGN(const std::string text,
                    file.read(0, std::min<std::uint64_t>(file.size(), kMaxMetadata)));
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::string_view line = std::string_view(text).substr(at, end - at);
      at = end + 1;
      line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
      if (!line.starts_with("- ")) {
        // Since version 5, "files:" repeats the names as "- path: NAME".
        if (line.find(':') != std::string_view::npos)
          listed = line.starts_with("relative_file_paths:");
        continue;
      }
      if (!listed) continue;
      line.remove_prefix(std::min(line.find_first_not_of(" \"'", 1), line.size()));
      line = line.substr(0, line.find_last_not_of(" \"'\r") + 1);
      // Older ones repeat the folder's name.
      const fs::path name = fs::path(line).filename();
      if (is_part_name(name.string()) &&
          std::find(parts.begin(), parts.end(), folder / name) == parts.end())
        parts.push_back(folder / name);
      if (parts.size() > kMaxParts)
        return fail_at(list.string(), ErrorCode::kResourceLimit,
                       "it lists more than {} files; import some of them at a time", kMaxParts);
    }
    if (!parts.empty()) return parts;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (is_part_name(entry.path().filename().string())) parts.push_back(entry.path());
  if (parts.size() == 1) return parts;
  if (parts.empty())
    return fail(ErrorCode::kMissingData, "there is no .mcap or .db3 in the folder");
  return fail(ErrorCode::kMissingData,
              "there are {} bags in the folder and no metadata.yaml that joins them; give one of "
              "them, or make it with ros2 bag reindex",
              parts.size());
}

}  // namespace

bool looks_like_bag(std::string_view begin) {
  return begin.starts_with(kRos1Magic) || begin.starts_with(kMcapMagic) ||
         begin.starts_with(kSqliteMagic);
}

bool is_part_name(std::string_view name) {
  for (const char* ending : {".mcap", ".db3", ".mcap.zstd", ".db3.zstd"})
    if (name.ends_with(ending)) return true;
  return false;
}

Bag::Bag(fs::path path, std::uint64_t bytes, const RunContext& context)
    : path_(std::move(path)), index_(std::make_unique<BagIndex>(bytes, context)) {}
Bag::Bag(Bag&&) noexcept = default;
Bag& Bag::operator=(Bag&&) noexcept = default;
Bag::~Bag() = default;

Result<Bag> Bag::open(const fs::path& path, const RunContext& context) {
  std::vector<fs::path> files{path};
  std::error_code error;
  if (fs::is_directory(path, error)) {
    TURNSCAN_ASSIGN(files, parts_of(path));
  }
  std::uint64_t bytes = 0;
  for (const fs::path& file : files)
    if (const std::uintmax_t size = fs::file_size(file, error); !error) bytes += size;
  Bag bag(path, bytes, context);
  for (const fs::path& file : files) {
    auto part = open_part(file, std::uint32_t(bag.parts_.size()), *bag.index_);
    if (!part) {
      Error failed = part.error();
      if (failed.path.empty()) failed.path = file.string();
      return tl::unexpected<Error>(std::move(failed));
    }
    bag.parts_.push_back(std::move(*part));
  }
  bag.index_->finish();
  return bag;
}

std::optional<MessagePlace> Bag::first(std::string_view topic) const {
  const auto all = messages(topic);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

Result<Payload> Bag::read(const MessagePlace& place, std::size_t most) const {
  const file::ReadBudget* charged = opening_ ? &budget() : nullptr;
  const BagPart& part = *parts_[place.file];
  TURNSCAN_ASSIGN(Payload out, part.read(place, most, charged));
  if (out.bytes.starts_with(kZstdMagic)) {  // which no message in ROS's formats begins with
    TURNSCAN_ASSIGN(out, part.read(place, kMaxMessageBytes, charged));
    TURNSCAN_ASSIGN(std::string bytes, unpacked_message(out.bytes, charged));
    out.owner = std::make_shared<const std::string>(std::move(bytes));
    out.bytes = std::string_view(*out.owner).substr(0, most);
  }
  out.wire = index_->connection(place).wire();
  return out;
}

}  // namespace turnscan::rosbag
