#include "harness/record/findings.h"

#include <algorithm>

namespace touchstone {

void Findings::add(Departure departure) {
  departure.where = one_line(std::move(departure.where));
  departure.what = one_line(std::move(departure.what));
  if (departure.row < 0) departure.row = static_cast<std::int64_t>(rows_.size()) - 1;
  const bool told = std::ranges::any_of(departures_, [&](const Departure& d) {
    return d.block == departure.block && d.algorithm == departure.algorithm &&
           d.where == departure.where && d.what == departure.what;
  });
  if (!told) departures_.push_back(std::move(departure));
}

bool Findings::ours_are_wrong() const {
  return std::ranges::any_of(departures_, [](const Departure& d) { return d.ours && !d.known; });
}

std::vector<std::string> departure_header() {
  return {"block", "row", "algorithm", "ours", "known", "where", "what", "reproduction"};
}

void write(CsvWriter& file, const Departure& departure) {
  file.field(departure.block).field(departure.row).field(departure.algorithm);
  file.field(departure.ours ? 1 : 0).field(departure.known ? 1 : 0);
  file.field(departure.where).field(departure.what).field(departure.reproduction);
  file.end_row();
}

std::vector<Departure> read_departures(const std::filesystem::path& file) {
  std::vector<Departure> departures;
  CsvReader(file, departure_header()).read([&](const CsvReader::Row& row) {
    departures.push_back({.block = row.integer(0),
                          .row = row.integer(1),
                          .algorithm = std::string(row.text(2)),
                          .ours = row.integer(3) != 0,
                          .known = row.integer(4) != 0,
                          .where = std::string(row.text(5)),
                          .what = std::string(row.text(6)),
                          .reproduction = std::string(row.text(7))});
  });
  return departures;
}

}  // namespace touchstone
