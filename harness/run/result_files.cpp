#include "harness/run/result_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <system_error>
#include <tuple>

#include "harness/error.h"
#include "harness/run/machine.h"

namespace touchstone {
namespace {

constexpr const char* finished_key = "finished";

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

// Where each line of the file ends, behind its line feed. What follows the last one is no line.
std::vector<std::uintmax_t> line_ends(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uintmax_t> ends;
  std::uintmax_t at = 0;
  for (std::string line; std::getline(stream, line) && !stream.eof();) {
    at += line.size() + 1;
    ends.push_back(at);
  }
  return ends;
}

// Cuts a file back to its first `lines` lines.
void cut(const std::filesystem::path& file, const std::vector<std::uintmax_t>& ends,
         std::size_t lines) {
  std::error_code error;
  std::filesystem::resize_file(file, lines == 0 ? 0 : ends[lines - 1], error);
  if (error) throw InputError(file.string(), 0, "cannot be cut: " + error.message());
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
    take_up(findings);
  } else {
    std::filesystem::create_directories(folder_, error);
    if (error) throw InputError(folder_.string(), 0, "cannot be made: " + error.message());
    begin_anew(start);
  }
  const auto keep = CsvWriter::Keep::appended_rows;
  row_file_ = std::make_unique<CsvWriter>(raw(), raw_header(), keep);
  departure_file_ = std::make_unique<CsvWriter>(departures(), departure_header(), keep);
  row_file_->flush();
  departure_file_->flush();
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
  // The rows go first: a machine.csv of this run beside rows of another would be trusted.
  for (const auto& file : {raw(), departures()}) {
    std::filesystem::remove(file, error);
    if (error) throw InputError(file.string(), 0, "cannot be replaced: " + error.message());
  }
  std::filesystem::remove_all(folder_ / "reproductions", error);
  write_facts(false);
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
  for (const auto& [name, value] : facts_) {
    const auto at = old.find(name);
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
  std::error_code error;
  if (!std::filesystem::exists(machine(), error)) {
    throw InputError(machine().string(), 0, "is not there; expected the folder of a run to resume");
  }
  compare_facts();
  std::vector<RawRow> rows;
  if (std::filesystem::exists(raw(), error)) {
    const std::vector<std::uintmax_t> ends = line_ends(raw());
    cut(raw(), ends, ends.size());
    if (!ends.empty()) {
      rows = read_raw_rows(raw());
      if (rows.size() + 1 != ends.size()) {
        throw InputError(raw().string(), 0, "a row of several lines; expected a line a row");
      }
      if (!was_finished_) {
        rows.resize(whole_rows(rows));
        cut(raw(), ends, rows.size() + 1);
      }
    }
  }
  rows_written_ = rows.size();
  const std::int64_t last_block = rows.empty() ? -1 : rows.back().block;
  for (RawRow& row : rows) findings.add(std::move(row));
  if (std::filesystem::exists(departures(), error)) {
    const std::vector<std::uintmax_t> ends = line_ends(departures());
    cut(departures(), ends, ends.size());
    std::size_t lines = ends.empty() ? 0 : 1;
    if (!ends.empty()) {
      // A check pass that is done again tells its departures again.
      for (Departure& departure : read_departures(departures())) {
        if (departure.block > last_block) break;
        findings.add(std::move(departure));
        ++lines;
      }
    }
    cut(departures(), ends, lines);
  }
  departures_written_ = findings.departures().size();
}

void ResultFiles::write_new(const Findings& findings) {
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
