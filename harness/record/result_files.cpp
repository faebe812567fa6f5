#include "harness/record/result_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

constexpr const char* finished_key = "finished";
constexpr double seconds_for_others = 2;

// Facts of the source folder, which may change beside a program that stays the same: what they were
// at the run's start is kept.
constexpr std::array<std::string_view, 2> source_facts = {"commit", "tree"};

bool is_sample(const RawRow& row) { return row.kind == RowKind::sample; }
bool is_check_pass(const RawRow& row) { return !is_sample(row) && row.process < 0; }

bool same_round(const RawRow& a, const RawRow& b) {
  const auto set = [](const RawRow& row) {
    const bool narrow = !row.narrow.empty();
    return std::tuple(row.block, narrow, narrow ? row.broad : "", row.task, row.pair_kind);
  };
  return is_sample(a) && is_sample(b) && set(a) == set(b) && a.square == b.square &&
         a.round == b.round;
}

// How many rows are certainly whole: without the last round, or the last check pass where no sample
// came after it.
std::size_t whole_rows(const std::vector<RawRow>& rows) {
  std::size_t kept = rows.size();
  if (kept == 0) return 0;
  const RawRow& last = rows.back();
  const auto goes = [&](const RawRow& row) {
    return is_sample(last) ? same_round(row, last)
                           : is_check_pass(last) && is_check_pass(row) && row.block == last.block;
  };
  while (kept > 0 && goes(rows[kept - 1])) --kept;
  return kept;
}

void cut(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return;
  std::filesystem::resize_file(file, bytes, error);
  if (error) throw InputError(file.string(), 0, "cannot be cut: " + error.message());
}

// Where each line of the file ends, behind its line feed. What follows the last one is no line, and
// is cut off. Empty where there is no file, or no header yet.
std::vector<std::uintmax_t> line_ends(const std::filesystem::path& file,
                                      const std::vector<std::string>& header) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uintmax_t> ends;
  std::uintmax_t at = 0;
  for (std::string line; std::getline(stream, line) && !stream.eof();) {
    if (ends.empty() && line != fmt::format("{}", fmt::join(header, ","))) {
      throw InputError(file.string(), 1,
                       fmt::format("other columns than this program writes; expected {} to resume",
                                   fmt::join(header, ",")));
    }
    at += line.size() + 1;
    ends.push_back(at);
  }
  stream.close();
  cut(file, at);
  return ends;
}

std::map<std::string, std::string> read_facts(const std::filesystem::path& file) {
  std::map<std::string, std::string> facts;
  CsvReader(file, {"name", "value"}).read([&](const CsvReader::Row& row) {
    facts.emplace(row.text(0), row.text(1));
  });
  return facts;
}

}  // namespace

ResultFiles::ResultFiles(std::filesystem::path folder, Facts facts, RunStart start,
                         Findings& findings)
    : folder_(std::move(folder)), facts_(std::move(facts)) {
  std::error_code error;
  if (start == RunStart::resume) {
    if (!std::filesystem::exists(machine(), error)) {
      throw InputError(machine().string(), 0,
                       "is not there; expected the folder of a run to resume");
    }
  } else {
    std::filesystem::create_directories(folder_, error);
    if (error) throw InputError(folder_.string(), 0, "cannot be made: " + error.message());
  }
  try {
    lock();
    remove_leftovers();
    if (start == RunStart::resume) {
      take_up(findings);
    } else {
      begin_anew(start);
    }
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

ResultFiles::~ResultFiles() { ::close(lock_); }

// Workers hold the lock too, and end a moment later than a program that was killed.
void ResultFiles::lock() {
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) {
    throw InputError(folder_.string(), 0, fmt::format("cannot be used: {}", std::strerror(errno)));
  }
  const Stopwatch watch;
  while (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;  // a file system without locks
    if (watch.seconds() > seconds_for_others) {
      throw InputError(folder_.string(), 0,
                       "another run is at work in it; expected a folder for each");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

// Of a machine.csv that was never whole, since a kill came before its time.
void ResultFiles::remove_leftovers() const {
  const std::string begin = machine().filename().string() + ".";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && name.ends_with(".tmp")) {
      std::filesystem::remove(entry.path(), error);
    }
  }
}

void ResultFiles::begin_anew(RunStart start) {
  std::error_code error;
  const bool any = std::filesystem::exists(raw(), error);
  if (start == RunStart::fresh && any) {
    const bool finished =
        std::filesystem::exists(machine(), error) && read_facts(machine())[finished_key] == "yes";
    if (!finished) {
      throw InputError(raw().string(), 0,
                       "is of a run that was not finished; expected --resume to go on with it, "
                       "--overwrite to lose it, or another --out");
    }
  }
  // machine.csv goes first and comes last: beside rows that are not its own it would be trusted.
  for (const auto& file : {machine(), raw(), departures()}) {
    std::filesystem::remove(file, error);
    if (error) throw InputError(file.string(), 0, "cannot be replaced: " + error.message());
  }
  std::filesystem::remove_all(folder_ / "reproductions", error);
  write_facts(false);
  open();
}

void ResultFiles::compare_facts() {
  std::map<std::string, std::string> old = read_facts(machine());
  was_finished_ = old[finished_key] == "yes";
  old.erase(finished_key);
  // Each command that the results come from is told, once.
  for (auto& [name, value] : facts_) {
    if (name != command_line_fact || !old.contains(name)) continue;
    const std::string& before = old[name];
    value = before.find(value) == std::string::npos ? before + " && " + value : before;
    old[name] = value;
  }
  for (auto& [name, value] : facts_) {
    const auto at = old.find(name);
    if (at != old.end() && std::ranges::find(source_facts, name) != source_facts.end()) {
      value = at->second;
    }
    if (at == old.end() || at->second != value) {
      throw InputError(machine().string(), 0,
                       fmt::format("{} was '{}' and is '{}' now; expected the same to resume", name,
                                   at == old.end() ? "" : at->second, value));
    }
    old.erase(at);
  }
  if (!old.empty()) {
    throw InputError(machine().string(), 0,
                     fmt::format("{} was '{}' and is not known now; expected the same to resume",
                                 old.begin()->first, old.begin()->second));
  }
}

void ResultFiles::take_up(Findings& findings) {
  compare_facts();
  std::vector<RawRow> rows;
  if (const auto ends = line_ends(raw(), raw_header()); !ends.empty()) {
    rows = read_raw_rows(raw());
    if (rows.size() + 1 != ends.size()) {
      throw InputError(raw().string(), 0, "a row of several lines; expected a line a row");
    }
    if (!was_finished_) rows.resize(whole_rows(rows));
    rows_end_ = ends[rows.size()];
  }
  rows_written_ = rows.size();
  for (RawRow& row : rows) findings.add(std::move(row));
  if (const auto ends = line_ends(departures(), departure_header()); !ends.empty()) {
    // Those of rows that are measured again are told again.
    for (Departure& departure : read_departures(departures())) {
      if (departure.row >= static_cast<std::int64_t>(rows_written_)) break;
      findings.add(std::move(departure));
    }
    departures_end_ = ends[findings.departures().size()];
  }
  departures_written_ = findings.departures().size();
  // Told now if it cannot be written.
  CsvWriter(raw(), raw_header(), CsvWriter::Keep::appended_rows);
}

void ResultFiles::open() {
  cut(raw(), rows_end_);
  cut(departures(), departures_end_);
  const auto keep = CsvWriter::Keep::appended_rows;
  row_file_ = std::make_unique<CsvWriter>(raw(), raw_header(), keep);
  departure_file_ = std::make_unique<CsvWriter>(departures(), departure_header(), keep);
  row_file_->flush();
  departure_file_->flush();
}

void ResultFiles::write_new(const Findings& findings) {
  if (!row_file_) open();
  // Departures first: a row that tells of one is not done again.
  for (; departures_written_ < findings.departures().size(); ++departures_written_) {
    write(*departure_file_, findings.departures()[departures_written_]);
  }
  departure_file_->flush();
  for (; rows_written_ < findings.rows().size(); ++rows_written_) {
    write(*row_file_, findings.rows()[rows_written_]);
  }
  row_file_->flush();
}

void ResultFiles::finish() {
  if (!row_file_) open();
  departure_file_->close();
  row_file_->close();
  write_facts(true);
}

void ResultFiles::write_facts(bool finished) const {
  CsvWriter csv(machine(), {"name", "value"});
  for (const auto& [name, value] : facts_) csv.field(name).field(value).end_row();
  csv.field(finished_key).field(finished ? "yes" : "no").end_row();
  csv.close();
}

}  // namespace touchstone
