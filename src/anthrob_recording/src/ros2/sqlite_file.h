#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace anthrob {

/// A database of SQLite that is read.
class SqliteFile {
 public:
  /// @throws BadInput if the file is missing or is no database
  explicit SqliteFile(const std::string& file);

  /// Whether it has a table (not a view, behind which anything may be) of that name.
  bool has_table(const std::string& name) const;
  const std::string& name() const { return file_; }

 private:
  friend class SqliteRows;
  [[noreturn]] void fail(const std::string& message) const;

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// The rows that a query gives, one after the other. Columns count from 0.
class SqliteRows {
 public:
  /// @param database must outlive this
  /// @throws BadInput if the tables have no such columns
  SqliteRows(const SqliteFile& database, const std::string& query);

  /// Goes to the next row. @return false after the last
  bool next();
  // @throws BadInput if the cell holds another type
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  /// Valid until next().
  std::pair<const void*, std::size_t> blob(int column) const;

 private:
  void require_type(int column, int type, const char* expected) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  const SqliteFile& file_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace anthrob
