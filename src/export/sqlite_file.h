// SPDX-License-Identifier: Apache-2.0
// A new SQLite database, written once from front to back. No journal: the file gets its final name only when it is
// whole. All functions throw Error(failed) naming the file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace skysweep::exports {

// A prepared statement without results; parameters count from 1.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::string& sql, std::string blamed);
  SqliteStatement& bind(int parameter, int value);
  SqliteStatement& bind_text(int parameter, const std::string& value);
  SqliteStatement& bind_blob(int parameter, const std::string& bytes);
  void run();

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::string blamed_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class SqliteFile {
 public:
  SqliteFile(const std::filesystem::path& path, const std::filesystem::path& blamed);
  void run(const std::string& sql) { prepare(sql).run(); }
  SqliteStatement prepare(const std::string& sql) { return {database_.get(), sql, blamed_}; }
  void close();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string blamed_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace skysweep::exports
