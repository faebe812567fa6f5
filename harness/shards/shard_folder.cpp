// Locks shards, keeps their attempts, and does the parts of a shard that are not done yet.
#include "harness/shards/shard_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <system_error>
#include <thread>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/files/text_file.h"
#include "harness/process/interrupt.h"
#include "harness/record/machine.h"
#include "harness/shards/shard_plan.h"

namespace touchstone::shards {
namespace {

// A process that was killed leaves its lock when its last worker has ended, a moment later.
constexpr double seconds_for_others = 2;

constexpr const char* lock_file = "lock";
constexpr const char* attempts_file = "attempts.csv";

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Returns "1234_7" for task 7 of job array 1234.
std::string job_name() {
  const std::string array = environment("SLURM_ARRAY_JOB_ID");
  return array.empty() ? environment("SLURM_JOB_ID")
                       : array + "_" + environment("SLURM_ARRAY_TASK_ID");
}

// Removes what a kill left of a line, so that the next row begins a line of its own.
void cut_last_line(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return;
  const std::string text = files::read_text(file);
  const std::size_t end = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (end < text.size()) std::filesystem::resize_file(file, end, ignored);
}

// Opens the lock for writing, without which some network file systems give no exclusive lock.
int open_lock(const std::filesystem::path& shard, int more) {
  return ::open((shard / lock_file).c_str(), O_RDWR | O_CLOEXEC | more, 0666);
}

}  // namespace

std::string_view to_string(Event event) {
  constexpr std::array<std::string_view, 4> names = {"begun", "done", "interrupted", "failed"};
  return names[static_cast<std::size_t>(event)];
}

std::filesystem::path shard_path(const std::filesystem::path& plan, std::int64_t shard) {
  return plan / "shards" / std::to_string(shard / 1000) / std::to_string(shard);
}

std::filesystem::path part_path(const std::filesystem::path& shard, base::UnitRange part) {
  return shard / ("part-" + to_string(part));
}

std::vector<Attempt> read_attempts(const std::filesystem::path& shard) {
  const std::filesystem::path file = shard / attempts_file;
  std::vector<Attempt> attempts;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return attempts;
  const std::string text = files::read_text(file);
  if (text.empty()) return attempts;
  try {
    record::reader_of<Attempt>(file).read([&](const files::CsvReader::Row& fields) {
      attempts.push_back(record::read_row<Attempt>(fields));
    });
  } catch (const base::InputError&) {
    // A kill cut the last line, or another machine is writing it.
    if (text.ends_with('\n')) throw;
  }
  return attempts;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data()
                                                                           : "unknown";
}

ShardLock::ShardLock(std::filesystem::path shard, std::int64_t number) : folder_(std::move(shard)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw base::InputError(folder_.string(), 0, "cannot be made: " + error.message());
  descriptor_ = open_lock(folder_, O_CREAT);
  const auto fail = [&](const std::string& message) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw base::InputError((folder_ / lock_file).string(), 0, message);
  };
  if (descriptor_ < 0) fail(fmt::format("cannot be used: {}", std::strerror(errno)));
  const base::Stopwatch watch;
  while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) {
      fail(fmt::format(
          "the file system has no locks ({}), and two processes could mix the rows of a "
          "shard; expected a plan in a folder with locks",
          std::strerror(errno)));
    }
    if (watch.seconds() > seconds_for_others) {
      const std::vector<Attempt> attempts = read_attempts(folder_);
      fail(attempts.empty()
               ? fmt::format("shard {} is being done by another process", number)
               : fmt::format("shard {} is being done on {} by process {} since {}", number,
                             attempts.back().host, attempts.back().process, attempts.back().time));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  cut_last_line(folder_ / attempts_file);
  const std::vector<Attempt> attempts = read_attempts(folder_);
  attempt_ = attempts.empty() ? 0 : attempts.back().attempt + 1;
}

ShardLock::~ShardLock() { ::close(descriptor_); }

void ShardLock::append(Event event, const std::string& words) {
  const Attempt row = {.attempt = attempt_,
                       .event = event,
                       .time = record::date_now(),
                       .host = host_name(),
                       .process = getpid(),
                       .job = job_name(),
                       .log = environment("TOUCHSTONE_LOG"),
                       .words = record::one_line(words)};
  files::CsvWriter file(folder_ / attempts_file, record::header_of<Attempt>(),
                        files::CsvWriter::Keep::appended_rows);
  record::write_row(file, row);
  file.close();
}

void ShardLock::begin() { append(Event::begun, ""); }

void ShardLock::end(Event event, const std::string& words) { append(event, words); }

bool is_locked(const std::filesystem::path& shard) {
  const int descriptor = open_lock(shard, 0);
  if (descriptor < 0) return false;
  const bool locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

namespace {

// Returns how a part is begun: what another machine measured in part is measured anew, since the
// ratios of a block hold within a machine only.
record::FolderStart start_of(const Work& work, const record::Facts& there) {
  if (there.empty()) return record::FolderStart::overwrite;
  const bool moved = work.is_timed() && record::value_of(there, host_fact) != host_name();
  return moved ? record::FolderStart::overwrite : record::FolderStart::resume;
}

PartEnd run_part(Work& work, const record::Part& part, const std::filesystem::path& folder,
                 int workers) {
  const record::Facts there = facts_of(folder);
  if (record::value_of(there, record::finished_fact) == "yes") return PartEnd::done;
  record::FolderStart start = start_of(work, there);
  if (start == record::FolderStart::resume) {
    try {
      return work.run(part, folder, start, workers);
    } catch (const record::OtherWork& error) {
      // Such as another kernel or another set of processors than before.
      fmt::print(stderr, "touchstone: {}\ntouchstone: the part is done anew\n", error.what());
      start = record::FolderStart::overwrite;
    }
  }
  return work.run(part, folder, start, workers);
}

// A disk that is full takes no row either, and what failed first is what is told.
void note_failure(ShardLock& lock, const std::string& words) {
  try {
    lock.end(Event::failed, words);
  } catch (const base::InputError&) {
  }
}

PartEnd run_parts(Work& work, const ShardPlan& plan, const PlannedShard& shard, int workers) {
  const process::InterruptGuard guard;
  record::Part part{.units = {}, .facts = part_facts(plan.id, shard.shard)};
  (work.is_timed() ? part.facts : part.notes).emplace_back(host_fact, host_name());
  for (const base::UnitRange& units : parts_of(work, shard.units)) {
    part.units = units;
    const std::filesystem::path folder = part_path(shard_path(plan.folder, shard.shard), units);
    if (run_part(work, part, folder, workers) == PartEnd::interrupted) return PartEnd::interrupted;
    if (process::InterruptGuard::raised() && units.end != shard.units.end) {
      return PartEnd::interrupted;
    }
  }
  return PartEnd::done;
}

}  // namespace

std::vector<base::UnitRange> parts_of(const Work& work, base::UnitRange units) {
  if (!work.is_timed()) return {units};
  std::vector<base::UnitRange> parts;
  for (std::int64_t unit = units.first; unit < units.end; ++unit) parts.push_back({unit, unit + 1});
  return parts;
}

record::Facts part_facts(const std::string& plan, std::int64_t shard) {
  return {{"plan", plan}, {"shard", std::to_string(shard)}};
}

record::Facts facts_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "machine.csv";
  std::error_code error;
  return std::filesystem::exists(file, error) ? record::read_facts(file) : record::Facts{};
}

ShardEnd run_shard(const std::filesystem::path& folder, std::int64_t number, int workers) {
  const ShardPlan plan = read_plan(folder);
  const PlannedShard& shard = plan.shard(number);
  ShardLock lock(shard_path(folder, number), number);
  const std::vector<Attempt> attempts = read_attempts(shard_path(folder, number));
  if (!attempts.empty() && attempts.back().event == Event::done) return ShardEnd::was_done;
  lock.begin();
  try {
    const std::unique_ptr<Work> work = read_work(plan.campaign(), plan.home);
    work->expect_planned(plan.identity, shard.units);
    if (run_parts(*work, plan, shard, workers) == PartEnd::done) {
      lock.end(Event::done, "");
      return ShardEnd::done;
    }
    const int signal = process::InterruptGuard::signal();
    lock.end(Event::interrupted, signal == 0 ? "" : strsignal(signal));
    return ShardEnd::interrupted;
  } catch (const std::exception& error) {
    note_failure(lock, error.what());
    throw;
  }
}

}  // namespace touchstone::shards
