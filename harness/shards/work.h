// Work that can be cut into shards: numbered units whose rows do not depend on the process that
// does them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/unit_range.h"
#include "harness/record/folder_files.h"
#include "harness/record/result_folder.h"

namespace touchstone::shards {

// A part whose units are all done, in a folder of its own.
struct DonePart {
  std::int64_t shard = 0;
  base::UnitRange units;
  std::filesystem::path folder;
  std::string machine;  // the name of the machine that did it
};

enum class PartEnd : std::uint8_t { done, interrupted };

// A folder that joined results are written into.
struct MergeFolder {
  std::filesystem::path path;   // where it is written
  std::filesystem::path place;  // where it is put when it is whole
  record::Facts facts;          // of machine.csv
};

// What is said of merged results.
struct Merged {
  std::string text;  // for the terminal
  bool ours_wrong = false;
};

class Work {
 public:
  Work() = default;
  virtual ~Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  virtual std::string_view kind() const = 0;    // "run", "check" or "trade"
  virtual const std::string& name() const = 0;  // the file's
  virtual std::int64_t units() const = 0;
  // True if rows hold times. Then each unit is a part of its own, done by one machine that does
  // nothing else meanwhile, because ratios hold within a machine only.
  virtual bool is_timed() const = 0;
  // True if this unit must be in the shard of the one before: their times are compared.
  virtual bool belongs_to_previous(std::int64_t unit) const = 0;
  // Returns the facts that decide the rows; they are equal for all shards.
  virtual record::Facts identity() const = 0;
  // Returns approximate processor seconds of the first units; the others repeat them. They come from
  // trials, or from the rows of an earlier run of the same campaign in the folder `earlier`. Throws
  // InputError if that has none for them.
  virtual std::vector<double> estimate(const std::filesystem::path& earlier) const = 0;
  // Throws InputError if these units would have other rows than those that were planned, such as
  // those of a scene that was changed since.
  virtual void expect_planned(const record::Facts& planned, base::UnitRange units) const = 0;

  // Does a part into a folder, or goes on with it. An interrupt ends it where nothing is lost.
  // `workers` is the number of processes for work that is not timed.
  virtual PartEnd run(const record::Part& part, const std::filesystem::path& folder,
                      record::FolderStart start, int workers) = 0;

  // Returns the names of the files with rows, which grow with the work.
  virtual std::vector<std::string> row_files() const = 0;
  // Joins the parts, which are in the order of their units and may have gaps, into the folder, with
  // everything that is made of all rows.
  virtual Merged merge(std::span<const DonePart> parts, const MergeFolder& folder) = 0;
};

// Reads a campaign, or a file with a table [trade], [check], [stress] or [soak]. Scenes are relative
// to the folder `home`; without one, to that of the file. Throws InputError.
std::unique_ptr<Work> read_work(const std::filesystem::path& file,
                                const std::filesystem::path& home = {});

// The kinds of work, for read_work.
std::unique_ptr<Work> campaign_work(const std::filesystem::path& file,
                                    const std::filesystem::path& home);
std::unique_ptr<Work> check_work(const std::filesystem::path& file);
std::unique_ptr<Work> trade_work(const std::filesystem::path& file,
                                 const std::filesystem::path& home);

// Throws InputError if `earlier` is not empty: only a campaign's rows have the time of each unit.
void expect_no_earlier(const std::filesystem::path& earlier);

// Throws InputError if a fact of `now` is not among the planned ones.
void expect_facts(const record::Facts& planned, const record::Facts& now);

}  // namespace touchstone::shards
