// What a check does for a kind: the work of its jobs, the rows that they append, and the report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "harness/kinds/check_request.h"
#include "harness/process/worker_pool.h"
#include "harness/record/result_folder.h"

namespace touchstone::kinds {

class Checker {
 public:
  virtual ~Checker() = default;

  // The files of its rows. A job has its rows, as bytes for `keep`; it is done in a child process.
  virtual std::vector<record::RowFile> files() const { return {}; }
  // `family` is a place in the request, of a family of the kind.
  virtual std::string do_job(std::uint32_t /*family*/, std::uint64_t /*round*/) {
    throw std::logic_error("a kind without families has no jobs");
  }
  // Writes a job's rows and counts them; `first` is the place of its first file in the folder.
  virtual void keep(const std::string& /*rows*/, record::ResultFolder& /*folder*/,
                    std::size_t /*first*/) {}
  // Counts the rows of a folder that is resumed.
  virtual void take_up(const record::ResultFolder& /*folder*/, std::size_t /*first*/) {}

  // Proves the exact answers of the first round's cases of a family: a certificate a line; none where there are no
  // proofs.
  virtual std::string certificates(std::uint32_t /*family*/) { return ""; }

  // Further files that are made of the rows, and also while the check goes on, after so many jobs.
  virtual std::vector<std::string> made() const { return {}; }
  virtual void write_made(std::int64_t /*jobs*/) const {}

  // After the last job: writes the cases of what is wrong into failures/ of the request's folder, and tables.
  virtual void finish() {}
  // The faults of ours, a line each. Empty if there are none.
  virtual std::vector<std::string> ours_wrong() const { return {}; }
  // Commands that show these faults.
  virtual std::vector<std::string> commands() const { return {}; }
  // For the terminal.
  virtual std::string text(std::size_t /*page_width*/) const { return ""; }
  // Sections of the Markdown page, and those at its end. `pictures` is the path of the maps of axes from the
  // page's folder; empty if there are none.
  virtual std::string page(const std::string& /*pictures*/) const { return ""; }
  virtual std::string page_end() const { return ""; }
};

// The rows of a job, by their type.
template <class... Row>
struct JobRows {
  std::tuple<std::vector<Row>...> lists;

  template <class One>
  std::vector<One>& of() {
    return std::get<std::vector<One>>(lists);
  }
  template <class Visit>
  void for_each_field(Visit visit) {
    std::apply([&](auto&... list) { (visit(list), ...); }, lists);
  }
};

// A checker with a file of rows for each of these types. `Derived` has the names of the files, the context of
// the rows' columns, the work of a job, and the counting of a row:
//   static constexpr std::array row_files = {"jobs.csv"};
//   const Subjects& subjects() const;
//   JobRows<Row...> rows_of_job(std::uint32_t family, std::uint64_t round);
//   void add(const Row& row);  // of each type
template <class Derived, class... Row>
class RowChecker : public Checker {
 public:
  std::vector<record::RowFile> files() const final {
    std::size_t file = 0;
    return {
        record::RowFile{Derived::row_files[file++], record::header_of<Row>(self().subjects())}...};
  }
  std::string do_job(std::uint32_t family, std::uint64_t round) final {
    return process::to_bytes(self().rows_of_job(family, round));
  }
  void keep(const std::string& rows, record::ResultFolder& folder, std::size_t first) final {
    auto lists = process::from_bytes<JobRows<Row...>>(rows);
    const auto keep_all = [&]<class One>(const std::vector<One>& list) {
      for (const One& row : list) {
        folder.write(first, row, self().subjects());
        self().add(row);
      }
      ++first;
    };
    (keep_all(lists.template of<Row>()), ...);
  }
  void take_up(const record::ResultFolder& folder, std::size_t first) final {
    (folder.each_row<Row>(
         first++, [&](const Row& row) { self().add(row); }, self().subjects()),
     ...);
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
  const Derived& self() const { return static_cast<const Derived&>(*this); }
};

}  // namespace touchstone::kinds
