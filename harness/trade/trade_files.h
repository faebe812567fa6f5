// The folder of a trade; trade_rows.h has the columns of its files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/result_folder.h"
#include "harness/trade/trade_job.h"

namespace touchstone::trade {

class TradeFiles {
 public:
  // Begins the folder anew. All arguments but the path outlive it. Throws InputError if the folder
  // cannot be written, or another trade is at work in it.
  TradeFiles(const TradeRequest& request, const TradeScene& scene,
             const std::filesystem::path& folder);
  // Adds a row for each stage of the sample to samples.csv, and flushes it.
  void write(const PointSample& sample, const Configuration& configuration);
  // Writes points.csv, bins.csv, front.csv, front.md, left_out.csv, trade.toml and machine.csv.
  void finish(const TradeResult& result);

 private:
  void write_points(const TradeResult& result) const;
  void write_bins(const TradeResult& result) const;
  void write_front(const TradeResult& result) const;

  const TradeRequest& request_;
  const TradeScene& scene_;
  std::string scene_hash_;
  std::filesystem::path path_;
  record::ResultFolder folder_;
};

// Returns the front as a table for a terminal, with the notes that belong to it.
std::string front_text(const TradeResult& result, const TradeRequest& request,
                       std::size_t page_width);

}  // namespace touchstone::trade
