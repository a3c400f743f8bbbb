// SPDX-License-Identifier: Apache-2.0
#include "export/sqlite_file.h"

#include <sqlite3.h>

#include "core/error.h"

namespace skysweep::exports {

namespace {

Error sqlite_error(sqlite3* database, const std::string& blamed) {
  return failure("cannot write " + blamed + ": " + (database ? sqlite3_errmsg(database) : "SQLite has no memory"));
}

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void SqliteFile::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

SqliteStatement::SqliteStatement(sqlite3* database, const std::string& sql, std::string blamed)
    : database_(database), blamed_(std::move(blamed)) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
    throw sqlite_error(database_, blamed_);
  statement_.reset(statement);
}

SqliteStatement& SqliteStatement::bind(int parameter, int value) {
  if (sqlite3_bind_int(statement_.get(), parameter, value) != SQLITE_OK) throw sqlite_error(database_, blamed_);
  return *this;
}

SqliteStatement& SqliteStatement::bind_text(int parameter, const std::string& value) {
  if (sqlite3_bind_text(statement_.get(), parameter, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT) !=
      SQLITE_OK)
    throw sqlite_error(database_, blamed_);
  return *this;
}

SqliteStatement& SqliteStatement::bind_blob(int parameter, const std::string& bytes) {
  if (sqlite3_bind_blob(statement_.get(), parameter, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT) !=
      SQLITE_OK)
    throw sqlite_error(database_, blamed_);
  return *this;
}

void SqliteStatement::run() {
  int result = SQLITE_ROW;
  while (result == SQLITE_ROW) result = sqlite3_step(statement_.get());  // pragmas answer with rows
  if (result != SQLITE_DONE) throw sqlite_error(database_, blamed_);
  sqlite3_reset(statement_.get());
}

SqliteFile::SqliteFile(const std::filesystem::path& path, const std::filesystem::path& blamed)
    : blamed_(blamed.string()) {
  sqlite3* database = nullptr;
  const int result = sqlite3_open(path.c_str(), &database);
  database_.reset(database);
  if (result != SQLITE_OK) throw sqlite_error(database, blamed_);
  run("PRAGMA journal_mode = OFF");
  run("PRAGMA synchronous = OFF");
  run("PRAGMA application_id = 1297105496");  // "MPBX": MBTiles
}

void SqliteFile::close() {
  if (sqlite3_close(database_.get()) != SQLITE_OK) throw sqlite_error(database_.get(), blamed_);
  static_cast<void>(database_.release());
}

}  // namespace skysweep::exports
