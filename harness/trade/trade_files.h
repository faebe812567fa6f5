// What a trade leaves behind; the columns are documented in results/README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/csv.h"
#include "harness/trade/trade_job.h"

namespace touchstone {

// raw.csv: a row for each stage of each sample, flushed round by round.
class TradeSamples {
 public:
  // All outlive it. InputError where the file cannot be written.
  TradeSamples(const std::filesystem::path& file, const TradeRequest& request,
               const TradeScene& scene, const std::vector<TradeOutcome>& points);
  void write(const PointSample& sample, std::size_t point);
  void close() { file_.close(); }

 private:
  const TradeRequest* request_;
  const TradeScene* scene_;
  const std::vector<TradeOutcome>* points_;
  std::string hash_;
  CsvWriter file_;
};

// points.csv, bins.csv, front.csv, front.md, left_out.csv, trade.toml and machine.csv.
void write_trade(const TradeResult& result, const TradeRequest& request, const TradeScene& scene,
                 const std::filesystem::path& folder);

// The front as a table for a terminal, with what is worth knowing beside it.
std::string front_text(const TradeResult& result, const TradeRequest& request,
                       std::size_t page_width);

}  // namespace touchstone
