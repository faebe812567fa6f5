#include "harness/check/axes/stress_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>
#include <system_error>

#include "harness/base/error.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

const std::vector<std::string> cell_header = {"axis", "value", "cases", "dropped", "unresolved"};

std::filesystem::path rows_file(const StressRequest& request) { return request.out / "stress.csv"; }
std::filesystem::path cells_file(const StressRequest& request) { return request.out / "cells.csv"; }

}  // namespace

StressFiles::StressFiles(const StressRequest& request)
    : request_(request),
      rows_path_(rows_file(request)),
      cells_path_(cells_file(request)),
      progress_path_(request.out / "progress.csv"),
      program_(hash_of_program()) {
  if (request.resume) {
    resume();
  } else {
    // First, so that rows of two requests never stand beside one's progress.
    std::error_code ignored;
    std::filesystem::remove(progress_path_, ignored);
  }
  const auto keep = request.resume ? CsvWriter::Keep::appended_rows : CsvWriter::Keep::flushed_rows;
  rows_file_ = std::make_unique<CsvWriter>(rows_path_, stress_header(), keep);
  cells_file_ = std::make_unique<CsvWriter>(cells_path_, cell_header, keep);
  rows_file_->flush();
  cells_file_->flush();
  note_progress();
}

std::vector<std::pair<std::string, std::string>> StressFiles::identity() const {
  std::vector<std::string_view> narrow, scalars;
  for (const NarrowPhaseEntry* entry : request_.narrow) narrow.push_back(entry->info.name);
  for (const Precision scalar : request_.scalars) scalars.push_back(to_string(scalar));
  std::string axes;
  for (const StressCell& cell : request_.cells) {
    if (cell.place == 0) axes += (axes.empty() ? "" : " ") + cell.axis->name;
  }
  return {{"seed", std::to_string(request_.seed)},
          {"cases", std::to_string(request_.cases)},
          {"narrow", fmt::format("{}", fmt::join(narrow, " "))},
          {"scalars", fmt::format("{}", fmt::join(scalars, " "))},
          {"axes", axes},
          {"time_limit", fmt::format("{}", request_.time_limit)},
          {"program", program_}};
}

void StressFiles::resume() {
  if (!std::filesystem::exists(progress_path_)) {
    throw InputError(progress_path_.string(), 0,
                     "no such file; expected the folder of a sweep that was interrupted");
  }
  std::map<std::string, std::string> found;
  CsvReader(progress_path_, {"name", "value"}).read([&](const CsvReader::Row& row) {
    found[std::string(row.text(0))] = row.text(1);
  });
  for (const auto& [name, now] : identity()) {
    if (found[name] == now) continue;
    throw InputError(
        progress_path_.string(), 0,
        fmt::format("the sweep that it is of had {} '{}', and this one has '{}'; expected the same "
                    "request and the same program, or no --resume",
                    name, found[name], now));
  }
  const auto number = [&](const std::string& name) {
    try {
      return static_cast<std::size_t>(std::stoull(found[name]));
    } catch (const std::logic_error&) {
      throw InputError(progress_path_.string(), 0,
                       fmt::format("{}: found '{}'; expected a number", name, found[name]));
    }
  };
  cells_ = number("cells");
  for (const auto& path : {rows_path_, cells_path_}) {
    const std::size_t size = number(path.filename().string());
    std::error_code error;
    const std::uintmax_t there = std::filesystem::file_size(path, error);
    if (error || there < size) {
      throw InputError(path.string(), 0,
                       fmt::format("{} bytes; expected at least {}, as progress.csv says",
                                   error ? 0 : there, size));
    }
    std::filesystem::resize_file(path, size);
  }
}

void StressFiles::note_progress() {
  CsvWriter csv(progress_path_, {"name", "value"});
  const auto add = [&](std::string_view name, std::string_view value) {
    csv.field(name).field(value).end_row();
  };
  for (const auto& [name, value] : identity()) add(name, value);
  add("cells", std::to_string(cells_));
  for (const auto& path : {rows_path_, cells_path_}) {
    add(path.filename().string(), std::to_string(std::filesystem::file_size(path)));
  }
  csv.close();
}

void StressFiles::write(const CellResult& result) {
  for (const StressRow& row : result.rows) touchstone::write(*rows_file_, row, request_);
  const CellSummary& cell = result.summary;
  const StressCell& place = request_.cells[cell.cell];
  cells_file_->field(place.axis->name).field(place.value().name);
  cells_file_->field(cell.cases).field(cell.dropped).field(cell.unresolved).end_row();
  rows_file_->flush();
  cells_file_->flush();
  ++cells_;
  note_progress();
}

void StressFiles::close() {
  rows_file_->close();
  cells_file_->close();
}

std::vector<StressRow> read_stress_rows(const StressRequest& request) {
  std::vector<StressRow> rows;
  CsvReader(rows_file(request), stress_header()).read([&](const CsvReader::Row& row) {
    rows.push_back(read_stress_row(row, request));
  });
  return rows;
}

std::vector<CellSummary> read_cell_summaries(const StressRequest& request) {
  std::vector<CellSummary> cells;
  CsvReader(cells_file(request), cell_header).read([&](const CsvReader::Row& row) {
    const auto small = [&](std::size_t column) {
      return static_cast<std::int32_t>(row.integer(column));
    };
    cells.push_back({static_cast<std::uint32_t>(cells.size()), small(2), small(3), small(4)});
  });
  return cells;
}

}  // namespace touchstone
