#include "harness/check/check_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>

#include "harness/base/error.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

const std::vector<std::string> variant_header = {
    "regime",           "group",      "round", "algorithm", "scalar",        "task",
    "variant",          "compared",   "flips", "lost",      "beyond_margin", "worst_flip",
    "worst_difference", "worst_index"};
const std::vector<std::string> job_header = {"regime",       "group",      "round",   "cases",
                                             "unresolved",   "proven",     "refused", "boxes",
                                             "boxes_broken", "worst_index"};

template <class Entry>
std::string names_of(const std::vector<const Entry*>& entries) {
  std::vector<std::string_view> names;
  names.reserve(entries.size());
  for (const Entry* entry : entries) names.push_back(entry->info.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::map<std::string, std::string> read_pairs(const std::filesystem::path& file) {
  std::map<std::string, std::string> pairs;
  CsvReader(file, {"name", "value"}).read([&](const CsvReader::Row& row) {
    pairs[std::string(row.text(0))] = row.text(1);
  });
  return pairs;
}

}  // namespace

CheckFiles::CheckFiles(const CheckRequest& request, Tally& tally)
    : request_(request),
      progress_(request.out / "progress.csv"),
      program_(hash_of_program()),
      grades_{request.out / "grades.csv", nullptr},
      variants_{request.out / "variants.csv", nullptr},
      summaries_{request.out / "jobs.csv", nullptr} {
  if (request.resume) {
    resume(tally);
  } else {
    // First, so that rows of two requests never stand beside one's progress.
    std::error_code ignored;
    std::filesystem::remove(progress_, ignored);
  }
  const auto keep = request.resume ? CsvWriter::Keep::appended_rows : CsvWriter::Keep::flushed_rows;
  grades_.csv = std::make_unique<CsvWriter>(grades_.path, graded_answer_header(), keep);
  variants_.csv = std::make_unique<CsvWriter>(variants_.path, variant_header, keep);
  summaries_.csv = std::make_unique<CsvWriter>(summaries_.path, job_header, keep);
  for (File* file : files()) file->csv->flush();
  note_progress();
}

std::vector<std::pair<std::string, std::string>> CheckFiles::identity() const {
  std::vector<std::string_view> regimes;
  regimes.reserve(request_.regimes.size());
  for (const Regime* regime : request_.regimes) regimes.push_back(regime->name);
  std::vector<std::string_view> scalars;
  scalars.reserve(request_.scalars.size());
  for (const Precision scalar : request_.scalars) scalars.push_back(to_string(scalar));
  return {{"seed", std::to_string(request_.seed)},
          {"cases", std::to_string(request_.cases)},
          {"narrow", names_of(request_.narrow)},
          {"scalars", fmt::format("{}", fmt::join(scalars, " "))},
          {"regimes", fmt::format("{}", fmt::join(regimes, " "))},
          {"time_limit", fmt::format("{}", request_.time_limit)},
          {"program", program_}};
}

void CheckFiles::resume(Tally& tally) {
  if (!std::filesystem::exists(progress_)) {
    throw InputError(progress_.string(), 0,
                     "no such file; expected the folder of a check that was interrupted");
  }
  const std::map<std::string, std::string> found = read_pairs(progress_);
  const auto value = [&](const std::string& name) {
    const auto at = found.find(name);
    if (at != found.end()) return at->second;
    throw InputError(progress_.string(), 0, fmt::format("no '{}'", name));
  };
  for (const auto& [name, now] : identity()) {
    if (value(name) == now) continue;
    throw InputError(
        progress_.string(), 0,
        fmt::format("the check that it is of had {} '{}', and this one has '{}'; expected the same "
                    "request and the same program, or no --resume",
                    name, value(name), now));
  }
  const auto number = [&](const std::string& name) {
    try {
      return static_cast<std::size_t>(std::stoull(value(name)));
    } catch (const std::logic_error&) {
      throw InputError(progress_.string(), 0,
                       fmt::format("{}: found '{}'; expected a number", name, value(name)));
    }
  };
  jobs_ = number("jobs");
  for (const File* file : files()) {
    const std::size_t size = number(file->path.filename().string());
    std::error_code error;
    const std::uintmax_t there = std::filesystem::file_size(file->path, error);
    if (error || there < size) {
      throw InputError(file->path.string(), 0,
                       fmt::format("{} bytes; expected at least {}, as progress.csv says",
                                   error ? 0 : there, size));
    }
    std::filesystem::resize_file(file->path, size);
  }
  const CheckSubjects subjects = request_.subjects();
  CsvReader(grades_.path, graded_answer_header()).read([&](const CsvReader::Row& row) {
    tally.add(read_graded_answer(row, subjects));
  });
  const auto place = [](const CsvReader::Row& row, std::size_t column, const auto& list,
                        const auto& name_of) {
    const auto at = std::ranges::find_if(
        list, [&](const auto* one) { return name_of(*one) == row.text(column); });
    if (at == list.end()) row.fail("a name that is not of this check");
    return static_cast<std::uint32_t>(at - list.begin());
  };
  const auto regime_name = [](const Regime& regime) { return regime.name; };
  const auto entry_name = [](const NarrowPhaseEntry& entry) { return entry.info.name; };
  CsvReader(variants_.path, variant_header).read([&](const CsvReader::Row& row) {
    VariantCount count;
    count.entry = place(row, 3, request_.narrow, entry_name);
    count.scalar = row.text(4) == "float" ? Precision::float32 : Precision::float64;
    count.task = row.text(5) == "intersect"  ? Task::intersect
                 : row.text(5) == "distance" ? Task::distance
                                             : Task::penetration;
    row.text(6).copy(count.variant.data(), count.variant.size() - 1);
    count.compared = row.integer(7);
    count.flips = row.integer(8);
    count.lost = row.integer(9);
    count.beyond = row.integer(10);
    count.worst_flip = row.number(11);
    count.worst_difference = row.number(12);
    count.worst_index = static_cast<std::uint64_t>(row.integer(13));
    tally.add(place(row, 0, request_.regimes, regime_name), count);
  });
  CsvReader(summaries_.path, job_header).read([&](const CsvReader::Row& row) {
    JobSummary job;
    job.regime = place(row, 0, request_.regimes, regime_name);
    job.round = static_cast<std::uint64_t>(row.integer(2));
    job.cases = row.integer(3);
    job.unresolved = row.integer(4);
    job.proven = row.integer(5);
    job.refused = row.integer(6);
    job.boxes = row.integer(7);
    job.boxes_broken = row.integer(8);
    job.worst_index = static_cast<std::uint64_t>(row.integer(9));
    tally.add(job);
  });
}

void CheckFiles::note_progress() {
  CsvWriter csv(progress_, {"name", "value"});
  const auto add = [&](std::string_view name, std::string_view value) {
    csv.field(name).field(value).end_row();
  };
  for (const auto& [name, value] : identity()) add(name, value);
  add("jobs", std::to_string(jobs_));
  for (const File* file : files()) {
    add(file->path.filename().string(), std::to_string(std::filesystem::file_size(file->path)));
  }
  csv.close();
}

void CheckFiles::write(const JobResult& result) {
  const CheckSubjects subjects = request_.subjects();
  const JobSummary& job = result.summary;
  const Regime& regime = *request_.regimes[job.regime];
  const auto round = static_cast<std::int64_t>(job.round);
  for (const GradedAnswer& answer : result.answers)
    touchstone::write(*grades_.csv, answer, subjects);
  for (const VariantCount& count : result.variants) {
    CsvWriter& csv = *variants_.csv;
    csv.field(regime.name).field(regime.group).field(round);
    csv.field(request_.narrow[count.entry]->info.name).field(to_string(count.scalar));
    csv.field(to_string(count.task)).field(count.name());
    csv.field(count.compared).field(count.flips).field(count.lost).field(count.beyond);
    csv.field(count.worst_flip).field(count.worst_difference);
    csv.field(static_cast<std::int64_t>(count.worst_index)).end_row();
  }
  CsvWriter& csv = *summaries_.csv;
  csv.field(regime.name).field(regime.group).field(round).field(job.cases).field(job.unresolved);
  csv.field(job.proven).field(job.refused).field(job.boxes).field(job.boxes_broken);
  csv.field(static_cast<std::int64_t>(job.worst_index)).end_row();
  for (File* file : files()) file->csv->flush();
  ++jobs_;
  note_progress();
}

void CheckFiles::close() {
  for (File* file : files()) file->csv->close();
}

}  // namespace touchstone
