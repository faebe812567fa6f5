// What a folder of results says of itself: files.txt, the files that this program wrote, and
// progress.csv, the units of work and the rows that are theirs; and the part of planned work that
// it may be.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/hash.h"
#include "harness/base/unit_range.h"
#include "harness/record/machine.h"

namespace touchstone::record {

// The files below a folder of results that this program wrote and may remove.
//
// FOLDER/files.txt lists them, a path in the folder a line. Whatever else is in the folder is
// somebody else's: it is neither removed nor overwritten. The files of rows, machine.csv and others
// with fixed names are not in the list; ResultFolder knows them.

class OwnFiles {
 public:
  static constexpr const char* list_name = "files.txt";

  // Throws InputError if the list is no regular file, or names a path outside the folder.
  explicit OwnFiles(std::filesystem::path folder);

  bool has(const std::string& name) const { return names_.contains(name); }
  // Returns true for what a kill left of a listed file, or of the list, while it was written.
  bool has_leftover(const std::string& name) const;

  // Returns FOLDER/SUBFOLDER/NAME, where the name is that of base::safe_file_name, followed by "-2",
  // "-3", ... if a file there already has it with any ending. Makes the subfolder; "" is the folder
  // itself. Throws InputError if a symbolic link is on the way, or the subfolder cannot be made.
  std::filesystem::path free_stem(const std::filesystem::path& subfolder,
                                  std::string_view text) const;
  // Adds files of the folder to the list. Throws InputError if the list cannot be written.
  void note(const std::vector<std::filesystem::path>& files);
  // Adds the files that are there and are called the stem and an ending.
  void note_stem(const std::filesystem::path& stem);
  // Removes the listed files of which `is_meant` is true for the path in the folder, and the
  // subfolders that are empty then. A file behind a symbolic link stays. Throws InputError if one
  // cannot be removed.
  void remove(const std::function<bool(const std::string&)>& is_meant);

 private:
  std::filesystem::path list() const { return folder_ / list_name; }
  void write() const;
  // Returns true if a folder between this one and the file is a symbolic link.
  bool is_behind_link(const std::filesystem::path& name) const;

  std::filesystem::path folder_;
  std::set<std::string> names_;
};

// A part of planned work that is done by itself.

// The folder of a part holds the rows of its units, without what is made of all rows.
struct Part {
  base::UnitRange units;
  // Facts of machine.csv that say whose part it is: the plan, the shard, and more. They must be
  // equal to resume.
  Facts facts;
  Facts notes = {};  // further ones, which may differ
};

inline constexpr const char* part_fact = "part";

// Appends the facts of a part.
inline void append_facts(const Part& part, Facts& facts) {
  facts.emplace_back(part_fact, to_string(part.units));
  facts.insert(facts.end(), part.facts.begin(), part.facts.end());
}

// progress.csv of a folder of results: how many units of work it holds, and which rows are theirs.

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
