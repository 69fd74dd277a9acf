#include "ros2/sqlite_file.h"

#include <sqlite3.h>

#include <filesystem>
#include <utility>

#include "anthrob_core/errors.h"

namespace anthrob {

void SqliteFile::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

SqliteFile::SqliteFile(const std::string& file) : file_(file) {
  if (!std::filesystem::is_regular_file(file)) throw BadInput(file + ": no such file");
  sqlite3* database = nullptr;
  const int status = sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
  database_.reset(database);
  if (status != SQLITE_OK) fail("cannot be opened");
  // A file from elsewhere: its structure is checked, and nothing in its schema is run.
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  for (const char* pragma : {"PRAGMA cell_size_check = ON", "SELECT count(*) FROM sqlite_master"}) {
    if (sqlite3_exec(database, pragma, nullptr, nullptr, nullptr) != SQLITE_OK) {
      fail("cannot be read as a database of SQLite");
    }
  }
}

void SqliteFile::fail(const std::string& message) const {
  throw BadInput(file_ + ": " + message + ": " + sqlite3_errmsg(database_.get()));
}

bool SqliteFile::has_table(const std::string& name) const {
  SqliteRows rows(*this, "SELECT name FROM sqlite_master WHERE type = 'table'");
  while (rows.next()) {
    if (rows.text(0) == name) return true;
  }
  return false;
}

void SqliteRows::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteRows::SqliteRows(const SqliteFile& database, const std::string& query) : file_(database) {
  sqlite3_stmt* statement = nullptr;
  const int status = sqlite3_prepare_v2(database.database_.get(), query.c_str(),
                                        static_cast<int>(query.size()), &statement, nullptr);
  statement_.reset(statement);
  if (status != SQLITE_OK) database.fail("is no bag of ROS 2");
}

bool SqliteRows::next() {
  const int status = sqlite3_step(statement_.get());
  if (status == SQLITE_ROW) return true;
  if (status != SQLITE_DONE) file_.fail("is damaged or in use");
  return false;
}

void SqliteRows::require_type(int column, int type, const char* expected) const {
  if (sqlite3_column_type(statement_.get(), column) == type) return;
  throw BadInput(file_.name() + ": " + sqlite3_column_name(statement_.get(), column) +
                 " in a row of its tables: expected " + expected);
}

std::int64_t SqliteRows::integer(int column) const {
  require_type(column, SQLITE_INTEGER, "a whole number");
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteRows::text(int column) const {
  require_type(column, SQLITE_TEXT, "a text");
  const unsigned char* text = sqlite3_column_text(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(size));
}

std::pair<const void*, std::size_t> SqliteRows::blob(int column) const {
  require_type(column, SQLITE_BLOB, "bytes");
  const void* data = sqlite3_column_blob(statement_.get(), column);
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

}  // namespace anthrob
