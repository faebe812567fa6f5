// Joins blocks and makes their tables.
#include "harness/shards/merged_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "harness/base/error.h"
#include "harness/base/file_text.h"
#include "harness/campaign/run_folder.h"
#include "harness/files/folders/inside.h"
#include "harness/record/findings.h"
#include "harness/stats/machines.h"
#include "harness/stats/summary.h"

namespace touchstone::shards {
namespace {

enum : std::size_t { raw_file, departures_file };

constexpr const char* reproductions = "reproductions";

class RunMerge {
 public:
  explicit RunMerge(const MergeFolder& folder)
      : into_(folder.path),
        place_(folder.place),
        folder_({.folder = folder.path,
                 .files = campaign::run_files(),
                 .identity = folder.facts,
                 .start = record::FolderStart::overwrite,
                 .work = "merge"}) {}

  void add(const DonePart& part) {
    const std::int64_t rows = folder_.append(raw_file, part.folder);
    for (record::Departure& one :
         record::read_rows<record::Departure>(part.folder / "departures.csv")) {
      if (one.row >= 0) one.row += rows_;
      if (!one.reproduction.empty()) one.reproduction = take_reproduction(part, one.reproduction);
      folder_.write(departures_file, one);
      departures_.push_back(std::move(one));
    }
    blocks_.push_back({part.units.first, part.shard, part.machine, rows});
    rows_ += rows;
  }

  Merged finish(const stats::Published& published) {
    folder_.commit();
    folder_.finish();
    record::write_rows(into_ / "blocks.csv", blocks_);
    Merged merged;
    merged.ours_wrong = record::ours_are_wrong(departures_);
    if (rows_ > most_rows_of_tables) {
      merged.text = fmt::format(
          "{} rows: their tables have to fit into memory, and are not made here; `touchstone "
          "tables` "
          "on the folder makes them\n",
          rows_);
    } else {
      merged.text = make_tables(published);
    }
    return merged;
  }

 private:
  // Copies the file into the merged folder and returns its name there.
  std::string take_reproduction(const DonePart& part, const std::string& file) {
    const std::size_t at = file.rfind(reproductions);
    if (at == std::string::npos) return file;
    const std::filesystem::path name = std::filesystem::path(file.substr(at)).lexically_normal();
    if (!files::is_regular_inside(part.folder / name, part.folder / reproductions)) {
      throw base::InputError(
          (part.folder / "departures.csv").string(), 0,
          fmt::format("names {}, which is no file in {} of the part; expected one",
                      base::shortened(name.string()), reproductions));
    }
    std::error_code error;
    std::filesystem::create_directories((into_ / name).parent_path(), error);
    std::filesystem::copy_file(part.folder / name, into_ / name,
                               std::filesystem::copy_options::skip_existing, error);
    if (error) {
      throw base::InputError((part.folder / name).string(), 0,
                             "cannot be copied: " + error.message());
    }
    return (place_ / name).string();
  }

  std::string make_tables(const stats::Published& published) const {
    const std::map<std::string, stats::Results> of_machines = stats::read_machines(into_);
    if (of_machines.size() == 1) {
      const stats::Results& results = of_machines.begin()->second;
      return stats::write_report(results, departures_, &published, {}, into_).summary;
    }
    return stats::write_machine_tables(of_machines, {}, 1, into_);
  }

  std::filesystem::path into_, place_;
  record::ResultFolder folder_;
  std::int64_t rows_ = 0;
  std::vector<stats::BlockRow> blocks_;
  std::vector<record::Departure> departures_;
};

}  // namespace

Merged merge_runs(std::span<const DonePart> parts, const stats::Published& published,
                  const MergeFolder& folder) {
  RunMerge merge(folder);
  for (const DonePart& part : parts) merge.add(part);
  return merge.finish(published);
}

}  // namespace touchstone::shards
