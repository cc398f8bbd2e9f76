#include <sqlite3.h>

#include <algorithm>
#include <mutex>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/rosbag/bag_part.hpp>

namespace turnscan::rosbag {

namespace {

constexpr int kOperations = 1000;              // between two looks at the budget ...
constexpr std::uint64_t kCharged = 16U << 10;  // ... to which they count as so many bytes
constexpr int kMaxExpression = 100;            // depth of an expression in a schema

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
struct CloseBlob {
  void operator()(sqlite3_blob* blob) const { sqlite3_blob_close(blob); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

tl::unexpected<Error> refused(sqlite3* database) {
  const int code = sqlite3_errcode(database) & 0xff;
  const bool of_content = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR ||
                          code == SQLITE_MISMATCH;
  return fail(of_content ? ErrorCode::kFormat : ErrorCode::kIo, "SQLite says: {}",
              file::clean_name(sqlite3_errmsg(database)));
}

/// As a URI's path.
std::string escaped(const std::string& path) {
  std::string out;
  for (const char c : path)
    out += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02x}", int(c)) : std::string(1, c);
  return out;
}

/// Nothing that the file defines beside its tables (views, triggers, ...) is run; see list() for
/// virtual tables and generated columns.
Result<Database> opened(const std::filesystem::path& path) {
  std::error_code error;
  // A bag that was not closed has its last messages in a journal beside it. Without one, nothing is
  // written beside the file, so that it may lie where nothing can be.
  const bool journal = std::filesystem::exists(path.string() + "-wal", error);
  const std::string uri =
      fmt::format("file://{}?{}", escaped(std::filesystem::absolute(path, error).string()),
                  journal ? "mode=ro" : "immutable=1");
  sqlite3* made = nullptr;
  const int state = sqlite3_open_v2(
      uri.c_str(), &made, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_FULLMUTEX, nullptr);
  Database out(made);
  if (made == nullptr)
    return fail(ErrorCode::kLibrary, "SQLite cannot begin; there may be too little memory");
  if (state != SQLITE_OK) return refused(made);
  sqlite3_limit(made, SQLITE_LIMIT_LENGTH, int(Bag::kMaxMessageBytes));
  sqlite3_limit(made, SQLITE_LIMIT_EXPR_DEPTH, kMaxExpression);
  sqlite3_limit(made, SQLITE_LIMIT_ATTACHED, 0);
  for (const int off : {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                        SQLITE_DBCONFIG_TRUSTED_SCHEMA})
    sqlite3_db_config(made, off, 0, nullptr);
  sqlite3_db_config(made, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_exec(made, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0", nullptr, nullptr, nullptr);
  return out;
}

class SqlitePart : public BagPart {
 public:
  SqlitePart(Database database, std::uint32_t number)
      : database_(std::move(database)), number_(number) {}

  Result<> list(BagIndex& index);
  Result<Payload> read(const MessagePlace& place, std::size_t most,
                       const file::ReadBudget* charged) const override;

 private:
  /// Calls row(statement) for each row.
  template <class Row>
  Result<> each(const char* query, const BagIndex& index, Row row) const;

  Database database_;
  std::uint32_t number_;
  mutable std::mutex guard_;
};

template <class Row>
Result<> SqlitePart::each(const char* query, const BagIndex& index, Row row) const {
  sqlite3_stmt* made = nullptr;
  if (sqlite3_prepare_v3(database_.get(), query, -1, SQLITE_PREPARE_NO_VTAB, &made, nullptr) !=
      SQLITE_OK) {
    TURNSCAN_TRY(index.budget().state());  // it may have ended the reading of the schema
    return refused(database_.get());
  }
  const Statement statement(made);
  int state = SQLITE_ROW;
  while ((state = sqlite3_step(made)) == SQLITE_ROW) TURNSCAN_TRY(row(made));
  TURNSCAN_TRY(index.budget().state());
  return state == SQLITE_DONE ? Result<>() : Result<>(refused(database_.get()));
}

std::string text_at(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? std::string()
                         : std::string(text, std::size_t(sqlite3_column_bytes(row, column)));
}

Result<> SqlitePart::list(BagIndex& index) {
  // Before the first query, which reads the schema: its pages may name each other again and again.
  sqlite3_progress_handler(
      database_.get(), kOperations,
      [](void* budget) {
        return static_cast<const file::ReadBudget*>(budget)->unpack(kCharged) ? 0 : 1;
      },
      const_cast<file::ReadBudget*>(&index.budget()));
  bool tables = false;
  TURNSCAN_TRY(each(
      "SELECT count(*) FROM sqlite_master WHERE type='table' AND name IN ('topics','messages')",
      index, [&](sqlite3_stmt* row) {
        tables = sqlite3_column_int(row, 0) == 2;
        return Result<>();
      }));
  if (!tables)
    return fail(ErrorCode::kUnsupported,
                "this SQLite database is no ROS 2 bag; of RTAB-Map's, import what rtabmap-export "
                "writes");
  // A generated column is an expression, of which one step can take as long as the file wants.
  for (const char* columns : {"PRAGMA table_xinfo(topics)", "PRAGMA table_xinfo(messages)"})
    TURNSCAN_TRY(each(columns, index, [&](sqlite3_stmt* row) -> Result<> {
      constexpr int kHidden = 6;
      if (sqlite3_column_int(row, kHidden) == 0) return {};
      return fail(ErrorCode::kUnsupported,
                  "a column of this SQLite database is computed; rosbag2 writes none such");
    }));
  const auto topics =
      each("SELECT id, name, type, serialization_format FROM topics", index,
           [&](sqlite3_stmt* row) -> Result<> {
             std::uint64_t bytes = 0;  // rows may share the pages of a long text
             for (int column = 1; column <= 3; ++column)
               bytes += std::uint64_t(sqlite3_column_bytes(row, column));
             TURNSCAN_TRY(index.budget().unpack(bytes));
             return index.add_connection({number_, std::uint32_t(sqlite3_column_int64(row, 0)),
                                          text_at(row, 1), text_at(row, 2), text_at(row, 3)});
           });
  if (!topics) return topics;
  const auto listed = each(
      "SELECT id, topic_id, timestamp FROM messages", index, [&](sqlite3_stmt* row) -> Result<> {
        for (int column = 0; column < 3; ++column)
          if (sqlite3_column_type(row, column) != SQLITE_INTEGER)
            return fail(ErrorCode::kFormat, "a message has no number, topic or time");
        const auto id = std::uint64_t(sqlite3_column_int64(row, 0));
        return index.add_message({sqlite3_column_int64(row, 2),
                                  std::uint32_t(sqlite3_column_int64(row, 1)), number_,
                                  std::uint32_t(id >> 32), std::uint32_t(id)});
      });
  sqlite3_progress_handler(database_.get(), 0, nullptr, nullptr);
  if (listed || listed.error().code != ErrorCode::kFormat) return listed;
  index.cut = listed.error().message;  // what comes before it can be read
  return {};
}

Result<Payload> SqlitePart::read(const MessagePlace& place, std::size_t most,
                                 const file::ReadBudget* charged) const {
  std::string bytes;
  {
    const std::lock_guard lock(guard_);
    const auto row = std::int64_t(std::uint64_t(place.chunk) << 32 | place.offset);
    sqlite3_blob* made = nullptr;
    const int state = sqlite3_blob_open(database_.get(), "main", "messages", "data", row, 0, &made);
    const std::unique_ptr<sqlite3_blob, CloseBlob> blob(made);
    if (state != SQLITE_OK) return refused(database_.get());
    const auto size = std::size_t(sqlite3_blob_bytes(made));
    if (size > Bag::kMaxMessageBytes)
      return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                  size);
    const std::size_t wanted = std::min(size, most);
    if (charged != nullptr) TURNSCAN_TRY(charged->unpack(wanted));
    bytes.resize(wanted);
    if (sqlite3_blob_read(made, bytes.data(), int(wanted), 0) != SQLITE_OK)
      return refused(database_.get());
  }
  Payload out;
  out.owner = std::make_shared<const std::string>(std::move(bytes));
  out.bytes = *out.owner;
  return out;
}

}  // namespace

PartResult open_sqlite_part(const std::filesystem::path& path, std::uint32_t number,
                            BagIndex& index) {
  TURNSCAN_ASSIGN(Database database, opened(path));
  auto part = std::make_unique<SqlitePart>(std::move(database), number);
  TURNSCAN_TRY(part->list(index));
  return part;
}

}  // namespace turnscan::rosbag
