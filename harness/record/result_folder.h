// A folder of results that one process fills, and that can be resumed after a stop.
//
// The folder holds
// - row files such as raw.csv, to which rows are appended;
// - progress.csv (name,value): the number of finished units of work, and the length and hash of each
//   row file at that moment. An interrupted unit (a round, a job, a cell) is measured anew;
// - machine.csv (name,value): the identity of the work, facts of the machine, and `finished`;
// - files.txt: further files that this program wrote (harness/record/folder_files.h).
// A kill at any moment loses at most the current unit. Files of others stay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "harness/record/folder_files.h"
#include "harness/record/machine.h"
#include "harness/record/row.h"

namespace touchstone::record {

// The folder holds other work than the one to resume, or that of another machine.
class OtherWork : public base::InputError {
  using InputError::InputError;
};

enum class FolderStart : std::uint8_t {
  fresh,      // refuses a folder that holds unfinished work
  overwrite,  // begins anew and discards the folder's results
  resume,     // continues the folder's results
};

// Returns FolderStart::resume if `resume` is true, else FolderStart::overwrite.
inline FolderStart resume_or_overwrite(bool resume) {
  return resume ? FolderStart::resume : FolderStart::overwrite;
}

struct RowFile {
  std::string name;  // relative to the folder
  std::vector<std::string> header;
};

struct ResultFolderPlan {
  std::filesystem::path folder;
  std::vector<RowFile> files;
  // Facts of machine.csv that must be equal to resume. Three may differ: `commit` and `tree` keep
  // their first value, and the values of `command_line` are joined.
  Facts identity;
  Facts notes = {};  // further facts of machine.csv, which may differ
  FolderStart start = FolderStart::fresh;
  std::string work = "run";  // for messages: run, check, sweep, ...
  // Further files that are made of the rows. They are removed when work begins anew, as are those
  // that files.txt lists.
  std::vector<std::string> made = {};
};

// Throws InputError if files cannot be written in the folder, or the folder cannot be made. Leaves
// nothing behind. Call it before long work.
void expect_writable(const std::filesystem::path& folder);

class ResultFolder {
 public:
  // Makes the folder if the work begins anew. To resume, cuts the row files back to the last whole
  // unit; `rows` reads them afterwards. Throws InputError if the folder cannot be written, is in
  // use by another process, or holds work that must not be lost, or files of others by the names of
  // the work's; or, to resume, if rows are not those that progress.csv says. Throws OtherWork if what
  // it holds cannot be resumed.
  explicit ResultFolder(ResultFolderPlan plan);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  std::filesystem::path path(const std::string& name) const { return plan_.folder / name; }
  bool was_finished() const { return was_finished_; }
  std::int64_t units() const { return units_; }  // the number done so far

  // Returns the rows that row file `file` (its index in the plan) held at the start.
  template <class Row, class... Context>
  std::vector<Row> rows(std::size_t file, const Context&... context) const {
    return read_rows<Row>(path(plan_.files[file].name), context...);
  }
  // Calls `take` for each of these rows, which need not fit into memory together.
  template <class Row, class Take, class... Context>
  void each_row(std::size_t file, const Take& take, const Context&... context) const {
    reader_of<Row>(path(plan_.files[file].name), context...)
        .read(
            [&](const files::CsvReader::Row& fields) { take(read_row<Row>(fields, context...)); });
  }
  // Appends a row; it counts from the next `commit` on.
  template <class Row, class... Context>
  void write(std::size_t file, const Row& row, const Context&... context) {
    write_row(writer(file), row, context...);
  }
  // Appends the rows of this file in another folder, whose work is finished, and returns their
  // number. Throws InputError if its columns differ, or if it does not have the size that its
  // progress.csv says.
  std::int64_t append(std::size_t file, const std::filesystem::path& other);
  // Work that was finished is not finished any more.
  files::CsvWriter& writer(std::size_t file) {
    if (is_finished_) begin_more();
    return *writers_[file];
  }
  // Ends `units` units: everything written since the last call is permanent from now on.
  void commit(std::int64_t units = 1);
  // Writes machine.csv with `finished` and these further facts.
  void finish(const Facts& more = {});

 private:
  std::filesystem::path machine() const { return path("machine.csv"); }
  std::filesystem::path progress() const { return path("progress.csv"); }
  void lock();
  void remove_leftovers() const;
  void begin_anew();
  // Throws InputError if one of these files is not of this program, or a symbolic link.
  void expect_own(const std::vector<std::filesystem::path>& names) const;
  void take_up();
  void begin_more();
  void compare_identity();
  void cut_to_progress();
  void open();
  void write_progress();
  void write_facts(bool finished, const Facts& more) const;

  ResultFolderPlan plan_;
  int lock_ = -1;                                    // descriptor of the folder
  bool was_finished_ = false, is_finished_ = false;  // at the start, and by machine.csv now
  std::string begun_;  // when the work was begun, not when it was resumed
  std::int64_t units_ = 0;
  std::vector<RowsOfFile> rows_;                            // what progress.csv says of each file
  std::vector<std::unique_ptr<files::CsvWriter>> writers_;  // one for each file
};

}  // namespace touchstone::record
