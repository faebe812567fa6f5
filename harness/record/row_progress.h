// progress.csv of a folder of results: how many units of work it holds, and which rows are theirs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/base/byte_hash.h"
#include "harness/record/facts.h"

namespace touchstone::record {

struct RowsOfFile {
  std::string name;       // of the file, in the folder
  std::int64_t size = 0;  // bytes up to the end of the last whole unit
  base::ByteHash hash;    // of these bytes
};

// Writes the folder's progress.csv (name,value): `units`; for each file of rows its length, NAME, and
// a hash, `NAME hash`, of its bytes, the number of units, and the plan, shard and part among the facts
// `identity` of the work. Throws InputError if it cannot be written.
void write_progress(const std::filesystem::path& folder, std::int64_t units,
                    std::span<const RowsOfFile> rows, const Facts& identity);

class RowProgress {
 public:
  // Reads the folder's progress.csv. Throws InputError if that is not whole.
  explicit RowProgress(std::filesystem::path folder);

  std::int64_t units() const { return units_; }
  // Returns the length of a file's rows, bytes. Throws InputError if there is none.
  std::int64_t size(const std::string& file) const;
  // Returns the file's rows. Throws InputError, with the file's name, if its first bytes are others
  // than those of which progress.csv has length and hash.
  RowsOfFile expect(const std::string& file, const Facts& identity) const;
  // Throws InputError if a file of rows is no regular file, or is not to the byte the one of which
  // progress.csv has length and hash.
  void expect_all(const Facts& identity) const;

 private:
  std::int64_t number(const std::string& name) const;

  std::filesystem::path folder_, file_;
  Facts facts_;
  std::int64_t units_ = 0;
};

}  // namespace touchstone::record
