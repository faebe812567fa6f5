// Functions that the commands about trades share.
#pragma once

#include <filesystem>
#include <string>

#include "harness/commands/arguments.h"
#include "harness/proxies/representation.h"
#include "harness/trade/trade_request.h"

namespace touchstone::commands {

// Returns the library's own representations.
inline trade::Representing representing() {
  return {proxies::represent, proxies::representation_error};
}

// Returns `out`, or results/local/trade-NAME if it is empty.
std::filesystem::path trade_folder(const std::string& out, const std::string& name);

// Measures, writes, prints and draws. Returns the exit status.
int run_trade(trade::TradeRequest request, const std::filesystem::path& folder, bool with_figure);

// What `advise --front` is asked.
struct FrontOptions {
  trade::TradeRequest request;  // without scene, name and measure
  std::string scene, out, error;
  bool plain = false, motion = false;
};

// Measures speed against accuracy on the scene. Returns the exit status.
int run_front(const FrontOptions& options);

// Adds the options for the question, the scene and the time.
void add_trade_axes(Arguments& command, trade::TradeRequest& request);
// Adds --error, whose value take_measure reads.
void add_error_measure(Arguments& command, std::string& name);
// Sets the measure of this name, or the task's own if it is empty.
void take_measure(const std::string& name, trade::TradeRequest& request);

}  // namespace touchstone::commands
