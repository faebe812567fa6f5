// Locks, cuts, appends and finishes a folder of results.
#include "harness/record/result_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/files/output_file.h"
#include "harness/files/packed_files.h"
#include "harness/files/text_file.h"
#include "harness/record/folder_files.h"
#include "harness/record/machine.h"

namespace touchstone::record {
namespace {

constexpr double seconds_for_others = 2;

// The source folder may change while the program stays equal.
constexpr std::array<std::string_view, 2> source_facts = {"commit", "tree"};

// Returns the length of the header's line, bytes.
std::uintmax_t header_size(const RowFile& file) {
  return fmt::format("{}\n", fmt::join(file.header, ",")).size();
}

void expect_header(const std::filesystem::path& path, const RowFile& file) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  const std::string expected = fmt::format("{}", fmt::join(file.header, ","));
  if (line == expected) return;
  throw base::InputError(
      path.string(), 1,
      fmt::format("other columns than this program writes; expected {} to resume", expected));
}

}  // namespace

void expect_writable(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder).lexically_normal();
  while (!std::filesystem::exists(there, error) && there != there.parent_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error)) {
    throw base::InputError(folder.string(), 0,
                           there.string() + " is no folder; expected one, or nothing there");
  }
  files::check_output(there / "machine.csv");
}

ResultFolder::ResultFolder(ResultFolderPlan plan) : plan_(std::move(plan)) {
  std::error_code error;
  if (plan_.start == FolderStart::resume) {
    if (!std::filesystem::exists(machine(), error)) {
      throw base::InputError(
          machine().string(), 0,
          fmt::format("is not there; expected the folder of a {} to resume", plan_.work));
    }
  } else {
    std::filesystem::create_directories(plan_.folder, error);
    if (error)
      throw base::InputError(plan_.folder.string(), 0, "cannot be made: " + error.message());
  }
  try {
    lock();
    remove_leftovers();
    plan_.start == FolderStart::resume ? take_up() : begin_anew();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

ResultFolder::~ResultFolder() { ::close(lock_); }

// Workers hold the lock too, and end a moment later than a program that was killed.
void ResultFolder::lock() {
  lock_ = ::open(plan_.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) {
    throw base::InputError(plan_.folder.string(), 0,
                           fmt::format("cannot be used: {}", std::strerror(errno)));
  }
  const base::Stopwatch watch;
  while (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;  // a file system without locks
    if (watch.seconds() > seconds_for_others) {
      throw base::InputError(
          plan_.folder.string(), 0,
          fmt::format("another {} is at work in it; expected a folder for each", plan_.work));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

// Removes the partial files that a kill left while they were written whole.
void ResultFolder::remove_leftovers() const {
  std::error_code error;
  const OwnFiles own(plan_.folder);
  for (const auto& entry : std::filesystem::directory_iterator(plan_.folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::string target = files::target_of_temporary(name).string();
    if (own.has_leftover(name) || target == "machine.csv" || target == "progress.csv" ||
        std::ranges::find(plan_.made, target) != plan_.made.end())
      std::filesystem::remove(entry.path(), error);
  }
}

void ResultFolder::begin_anew() {
  std::error_code error;
  if (plan_.start == FolderStart::fresh) {
    const bool finished = std::filesystem::exists(machine(), error) &&
                          value_of(read_facts(machine()), finished_fact) == "yes";
    for (const RowFile& file : plan_.files) {
      const std::filesystem::path rows = files::row_file(path(file.name));
      if (finished || !std::filesystem::exists(rows, error)) continue;
      throw base::InputError(
          rows.string(), 0,
          fmt::format("is of a {} that was not finished; expected --resume to go on "
                      "with it, --overwrite to lose it, or another --out",
                      plan_.work));
    }
  }
  std::vector<std::filesystem::path> old;
  for (const RowFile& file : plan_.files) {
    old.push_back(path(file.name));
    old.push_back(files::packed_name(path(file.name)));
  }
  for (const std::string& name : plan_.made) old.push_back(path(name));
  old.push_back(progress());
  // It is removed last and written first, so that rows never stand beside the facts of other work,
  // and so that a kill leaves a folder that is known as this program's.
  old.push_back(machine());
  OwnFiles own(plan_.folder);
  expect_own(old);
  own.remove([](const std::string&) { return true; });
  for (const auto& file : old) {
    std::filesystem::remove(file, error);
    if (error) throw base::InputError(file.string(), 0, "cannot be replaced: " + error.message());
  }
  begun_ = date_now();
  write_facts(false, {});
  open();
  write_progress();
}

void ResultFolder::expect_own(const std::vector<std::filesystem::path>& names) const {
  std::error_code error;
  const bool is_ours =
      std::filesystem::is_regular_file(std::filesystem::symlink_status(machine(), error)) &&
      !value_of(read_facts(machine()), finished_fact).empty();
  for (const std::filesystem::path& file : names) {
    const auto status = std::filesystem::symlink_status(file, error);
    if (!std::filesystem::exists(status)) continue;
    if (is_ours && std::filesystem::is_regular_file(status)) continue;
    throw base::InputError(
        file.string(), 0,
        fmt::format("was not written by this program; expected another folder for the {}, or that "
                    "file elsewhere",
                    plan_.work));
  }
}

void ResultFolder::compare_identity() {
  const Facts facts = read_facts(machine());
  std::map<std::string, std::string> old(facts.begin(), facts.end());
  was_finished_ = old[finished_fact] == "yes";
  old.erase(finished_fact);
  begun_ = old[begun_fact];
  old.erase(begun_fact);
  const auto fail = [&](const std::string& message) {
    throw OtherWork(machine().string(), 0, message + "; expected the same to resume");
  };
  for (auto& [name, value] : plan_.identity) {
    const auto at = old.find(name);
    if (at == old.end()) fail(fmt::format("{} was '' and is '{}' now", name, value));
    const std::string& before = at->second;
    if (name == command_line_fact) {
      // Every command that contributes to the results is noted once.
      value = before.find(value) == std::string::npos ? before + " && " + value : before;
    } else if (std::ranges::find(source_facts, name) != source_facts.end()) {
      value = before;
    } else if (before != value) {
      fail(fmt::format("{} was '{}' and is '{}' now", name, before, value));
    }
    old.erase(at);
  }
  for (const auto& [name, value] : plan_.notes) old.erase(name);
  if (!old.empty() && !was_finished_) {
    fail(fmt::format("{} was '{}' and is not known now", old.begin()->first, old.begin()->second));
  }
}

void ResultFolder::begin_more() {
  is_finished_ = false;
  write_facts(false, {});
}

void ResultFolder::take_up() {
  compare_identity();
  is_finished_ = was_finished_;
  cut_to_progress();
  open();
}

void ResultFolder::cut_to_progress() {
  std::error_code error;
  // Without progress.csv, the work was stopped before its first unit.
  std::optional<RowProgress> progress_there;
  if (std::filesystem::exists(progress(), error)) progress_there.emplace(plan_.folder);
  if (progress_there) units_ = progress_there->units();
  for (const RowFile& file : plan_.files) {
    const std::filesystem::path name = path(file.name);
    const std::filesystem::path rows = files::row_file(name);
    if (rows != name) {
      throw base::InputError(rows.string(), 0,
                             fmt::format("is packed; expected {} to resume, which `unzstd` makes "
                                         "of it",
                                         file.name));
    }
    const auto status = std::filesystem::symlink_status(name, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      throw base::InputError(name.string(), 0, "is no regular file; expected the rows to resume");
    }
    std::uintmax_t there = std::filesystem::file_size(name, error);
    if (error) there = 0;
    if (!progress_there && there > header_size(file)) {
      throw base::InputError(
          progress().string(), 0,
          fmt::format("is not there, beside rows in {}; expected the folder of a {} "
                      "of this program to resume",
                      file.name, plan_.work));
    }
    const std::uintmax_t size =
        progress_there ? static_cast<std::uintmax_t>(progress_there->size(file.name)) : 0;
    if (size > 0 && there > 0) expect_header(name, file);
    if (there < size) {
      throw base::InputError(
          name.string(), 0,
          fmt::format("{} bytes; expected at least {}, as progress.csv says", there, size));
    }
    rows_.push_back(progress_there ? progress_there->expect(file.name, plan_.identity)
                                   : RowsOfFile{.name = file.name, .hash = {}});
    if (there <= size) continue;
    if (was_finished_) {
      throw base::InputError(
          name.string(), 0,
          fmt::format("{} bytes; expected {} of a {} that is finished, as progress.csv says", there,
                      size, plan_.work));
    }
    std::filesystem::resize_file(name, size, error);
    if (error) throw base::InputError(name.string(), 0, "cannot be cut: " + error.message());
  }
}

void ResultFolder::open() {
  if (rows_.empty()) {
    for (const RowFile& file : plan_.files) rows_.push_back({.name = file.name, .hash = {}});
  }
  for (const RowFile& file : plan_.files) {
    writers_.push_back(std::make_unique<files::CsvWriter>(path(file.name), file.header,
                                                          files::CsvWriter::Keep::appended_rows));
  }
  for (const auto& writer : writers_) writer->flush();
}

void ResultFolder::commit(std::int64_t units) {
  for (const auto& writer : writers_) writer->flush();
  units_ += units;
  write_progress();
}

std::int64_t ResultFolder::append(std::size_t file, const std::filesystem::path& other) {
  const std::filesystem::path rows_there = other / plan_.files[file].name;
  expect_header(rows_there, plan_.files[file]);
  const auto size = static_cast<std::uintmax_t>(RowProgress(other).size(plan_.files[file].name));
  std::error_code error;
  const std::uintmax_t there = std::filesystem::file_size(rows_there, error);
  if (error || there != size) {
    throw base::InputError(
        rows_there.string(), 0,
        fmt::format("{} bytes; expected {}, as progress.csv says", error ? 0 : there, size));
  }
  std::ifstream stream(rows_there, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(header_size(plan_.files[file])));
  std::vector<char> buffer(std::size_t{1} << 20);
  std::int64_t rows = 0;
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const std::string_view lines(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    rows += std::ranges::count(lines, '\n');
    writer(file).lines(lines);
  }
  if (stream.bad()) throw base::InputError(rows_there.string(), 0, "cannot be read");
  return rows;
}

void ResultFolder::write_progress() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::int64_t size = writers_[i]->size();
    files::add_file(rows_[i].hash, path(rows_[i].name), rows_[i].size, size);
    rows_[i].size = size;
  }
  record::write_progress(plan_.folder, units_, rows_, plan_.identity);
}

void ResultFolder::finish(const Facts& more) {
  for (const auto& writer : writers_) writer->close();
  write_facts(true, more);
  is_finished_ = true;
}

void ResultFolder::write_facts(bool finished, const Facts& more) const {
  Facts facts = plan_.identity;
  for (const Facts* further : {&plan_.notes, &more})
    facts.insert(facts.end(), further->begin(), further->end());
  facts.emplace_back(begun_fact, begun_);
  facts.emplace_back(finished_fact, finished ? "yes" : "no");
  record::write_facts(machine(), facts);
}

}  // namespace touchstone::record
