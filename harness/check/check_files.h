// The rows that a check writes as it goes, and how one that was killed is gone on with.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/check/tally.h"
#include "harness/files/csv.h"

namespace touchstone {

// In the request's folder: grades.csv, variants.csv and jobs.csv, to which each job appends, and
// progress.csv, which says after each job how many are done and how long the three files then were,
// and for which request and which program. What is behind those lengths is a job that was
// interrupted, and is cut off.
class CheckFiles {
 public:
  // Begins the files; or, where the request says resume, goes on with them and counts the rows that
  // are there into `tally`. InputError where there is nothing to go on with, or what is there comes
  // from another request or program.
  CheckFiles(const CheckRequest& request, Tally& tally);

  std::size_t jobs() const { return jobs_; }  // done so far
  void write(const JobResult& result);        // of the next job
  void close();

 private:
  struct File {
    std::filesystem::path path;
    std::unique_ptr<CsvWriter> csv;
  };

  void resume(Tally& tally);
  void note_progress();
  std::vector<std::pair<std::string, std::string>> identity() const;
  std::vector<File*> files() { return {&grades_, &variants_, &summaries_}; }

  const CheckRequest& request_;
  std::filesystem::path progress_;
  std::string program_;  // 16 hexadecimal digits over the program's bytes
  File grades_, variants_, summaries_;
  std::size_t jobs_ = 0;
};

}  // namespace touchstone
