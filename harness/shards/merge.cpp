// Collects the parts of all shards and puts the joined results in their place.
#include "harness/shards/merge.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/names.h"
#include "harness/files/packed_files.h"
#include "harness/record/folder_files.h"
#include "harness/record/machine.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/status.h"

namespace touchstone::shards {
namespace {

namespace fs = std::filesystem;

class Merge {
 public:
  Merge(const fs::path& plan, const fs::path& out, const MergeSetting& setting)
      : plan_(read_plan(plan)),
        place_(out),
        out_(fs::absolute(out).lexically_normal()),
        setting_(setting) {
    if (!out_.has_filename()) out_ = out_.parent_path();
    temporary_ = out_;
    temporary_ += fmt::format("{}{}-{}", temporary_mark, host_name(), getpid());
  }
  ~Merge() {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  }
  Merge(const Merge&) = delete;
  Merge& operator=(const Merge&) = delete;

  MergeResult run() {
    expect_replaceable();
    MergeResult result = find_missing();
    if (!result.missing.empty() && !(setting_.partial && anything_done())) return result;
    const std::unique_ptr<Work> work = read_work(plan_.campaign(), plan_.home);
    expect_facts(plan_.identity, {{"program", record::hash_of_program()}});
    collect(*work);
    remove_leftovers();
    const record::Facts facts = merged_facts(result.missing_list);
    machines_.write(temporary_);
    result.merged = work->merge(parts_, {.path = temporary_, .place = place_, .facts = facts});
    record::write_rows(temporary_ / "shards.csv", rows_);
    write_facts(facts, result.missing.empty());
    if (setting_.zstd) {
      for (const std::string& name : work->row_files()) pack(temporary_ / name);
    }
    keep_files_of_others();
    put_in_place();
    result.written = true;
    base::replace_all(result.merged.text, temporary_.string(), place_.string());
    return result;
  }

 private:
  static constexpr const char* temporary_mark = ".merging-";

  void expect_replaceable() const {
    std::error_code error;
    if (!fs::exists(out_, error) || setting_.overwrite) return;
    if (fs::is_directory(out_, error) && fs::is_empty(out_, error)) return;
    if (record::value_of(facts_of(out_), "plan") == plan_.id) return;
    throw base::InputError(
        out_.string(), 0,
        "holds something else than results of this plan; expected another --out, "
        "or --overwrite to lose it");
  }

  MergeResult find_missing() {
    MergeResult result;
    std::vector<std::int64_t> missing;
    for (const PlannedShard& shard : plan_.shards) {
      ShardStatus status = status_of(plan_, shard.shard);
      if (status.state != ShardState::done) {
        missing.push_back(shard.shard);
        result.missing.push_back(fmt::format("shard {} is {}{}", shard.shard,
                                             to_string(status.state),
                                             status.words.empty() ? "" : ": " + status.words));
      }
      statuses_.push_back(std::move(status));
    }
    result.missing_list = list_of(missing);
    return result;
  }

  bool anything_done() const {
    return std::ranges::any_of(
        statuses_, [](const ShardStatus& status) { return status.state == ShardState::done; });
  }

  void collect(const Work& work) {
    for (const PlannedShard& shard : plan_.shards) {
      const ShardStatus& status = statuses_[static_cast<std::size_t>(shard.shard)];
      if (status.state != ShardState::done) continue;
      std::string machine;
      for (const base::UnitRange& units : parts_of(work, shard.units)) {
        DonePart& part = parts_.emplace_back();
        part.shard = shard.shard;
        part.units = units;
        part.folder = part_path(shard_path(plan_.folder, shard.shard), units);
        const record::Facts facts = facts_of(part.folder);
        expect_of_plan(part, facts);
        expect_host(part, facts);
        record::RowProgress(part.folder).expect_all(facts);
        part.machine = machine = machines_.name_of(facts);
        const std::string begun = record::value_of(facts, record::begun_fact);
        if (begun_.empty() || begun < begun_) begun_ = begun;
      }
      rows_.push_back({shard.shard, shard.units, machine,
                       status.begun ? status.begun->attempt + 1 : 0,
                       status.begun ? status.begun->time : "", status.ended});
    }
  }

  // A part that was copied from elsewhere, or removed, is no part of this plan.
  void expect_of_plan(const DonePart& part, const record::Facts& facts) const {
    record::Facts expected = part_facts(plan_.id, part.shard);
    expected.emplace_back(record::part_fact, to_string(part.units));
    expected.emplace_back(record::finished_fact, "yes");
    for (const auto& [name, value] : expected) {
      const std::string found = record::value_of(facts, name);
      if (found == value) continue;
      throw base::InputError(
          (part.folder / "machine.csv").string(), 0,
          fmt::format("{} is '{}'; expected '{}', as shard {} is said to be done", name, found,
                      value, part.shard));
    }
  }

  // The host names a folder of the results.
  static void expect_host(const DonePart& part, const record::Facts& facts) {
    const std::string fault = base::name_fault(record::value_of(facts, host_fact));
    if (fault.empty()) return;
    throw base::InputError((part.folder / "machine.csv").string(), 0,
                           fmt::format("{}: {}", host_fact, fault));
  }

  record::Facts merged_facts(const std::string& missing) const {
    record::Facts facts = plan_.identity;
    facts.emplace_back("plan", plan_.id);
    facts.emplace_back("shards", std::to_string(plan_.shards.size()));
    if (!missing.empty()) facts.emplace_back("missing", missing);
    facts.emplace_back("machines", std::to_string(machines_.size()));
    for (auto& [name, value] : machines_.shared()) {
      if (record::value_of(facts, name).empty()) facts.emplace_back(name, value);
    }
    return facts;
  }

  // The work wrote its own machine.csv, with the facts of this machine.
  void write_facts(record::Facts facts, bool finished) const {
    facts.emplace_back(record::begun_fact, begun_);
    facts.emplace_back(record::finished_fact, finished ? "yes" : "no");
    record::write_facts(temporary_ / "machine.csv", facts);
  }

  // Removes what merges into the same folder left on this machine when they were killed.
  void remove_leftovers() const {
    const std::string mark =
        fmt::format("{}{}{}-", out_.filename().string(), temporary_mark, host_name());
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(out_.parent_path(), error)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(mark)) continue;
      pid_t process = 0;
      std::from_chars(name.data() + mark.size(), name.data() + name.size(), process);
      if (process > 0 && (process == getpid() || kill(process, 0) != 0))
        fs::remove_all(entry.path(), error);
    }
  }

  static void pack(const fs::path& file) {
    files::ZstdWriter packed(files::packed_name(file));
    files::ByteReader bytes(file);
    std::vector<char> buffer(std::size_t{1} << 20);
    for (std::size_t got = 0; (got = bytes.read(buffer)) > 0;)
      packed.write(std::string_view(buffer.data(), got));
    packed.close();
    fs::remove(file);
  }

  // Returns the files in a folder, without the list of its own ones.
  static std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
      const bool is_folder = entry.is_directory(error) && !entry.is_symlink(error);
      if (!is_folder && entry.path() != folder / record::OwnFiles::list_name)
        files.push_back(entry.path());
    }
    return files;
  }

  // Lists all files of the results as this program's, and takes over from the folder that they
  // replace what somebody else has put there. The lists tell the two apart.
  void keep_files_of_others() const {
    std::error_code error;
    const std::vector<fs::path> results = files_in(temporary_);
    std::vector<fs::path> others;
    if (fs::is_directory(out_, error)) {
      const record::OwnFiles old(out_);
      for (const fs::path& file : files_in(out_)) {
        const std::string name = file.lexically_relative(out_).generic_string();
        if (!old.has(name) && !old.has_leftover(name) && !fs::exists(temporary_ / name, error))
          others.emplace_back(name);
      }
    }
    record::OwnFiles(temporary_).note(results);
    for (const fs::path& name : others) {
      fs::create_directories((temporary_ / name).parent_path(), error);
      // A link takes no room and no time; not every file system has them.
      fs::create_hard_link(out_ / name, temporary_ / name, error);
      if (error) fs::copy(out_ / name, temporary_ / name, fs::copy_options::copy_symlinks, error);
      if (error) {
        throw base::InputError((out_ / name).string(), 0,
                               "is not of these results, and cannot be kept: " + error.message());
      }
    }
  }

  // Exchanges the two folders, so that at every moment one of them is whole in its place.
  void put_in_place() const {
    std::error_code error;
    const auto fail = [&](const std::error_code& code) {
      throw base::InputError(out_.string(), 0, "cannot be put in place: " + code.message());
    };
    if (!fs::exists(out_, error)) {
      fs::rename(temporary_, out_, error);
      if (error) fail(error);
      return;
    }
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, out_.c_str(), RENAME_EXCHANGE) == 0)
      return;
    // A file system that cannot exchange: the old results keep another name for a moment.
    fs::path old = temporary_;
    old += "-old";
    fs::rename(out_, old, error);
    if (error) fail(error);
    fs::rename(temporary_, out_, error);
    if (error) fail(error);
    fs::remove_all(old, error);
  }

  ShardPlan plan_;
  fs::path place_;  // as the user names it
  fs::path out_, temporary_;
  MergeSetting setting_;
  std::vector<ShardStatus> statuses_;  // by shard
  std::vector<DonePart> parts_;
  std::vector<JoinedShard> rows_;
  Machines machines_;
  std::string begun_;  // of the first part
};

}  // namespace

MergeResult merge_plan(const fs::path& plan, const fs::path& out, const MergeSetting& setting) {
  return Merge(plan, out, setting).run();
}

}  // namespace touchstone::shards
