// Functions that the commands about trades share.
#pragma once

#include <filesystem>
#include <string>

#include "harness/commands/arguments.h"
#include "harness/proxies/representation.h"
#include "harness/trade/trade_request.h"

namespace touchstone {

// The library's own representations.
inline Representing representing() { return {represent, representation_error}; }

// Returns `out`, or results/local/trade-NAME where it is empty.
std::filesystem::path trade_folder(const std::string& out, const std::string& name);

// Measures, writes, prints and draws. Returns the exit status.
int run_trade(TradeRequest request, const std::filesystem::path& folder, bool with_figure);

// Adds the options for the question, the scene and the time.
void add_trade_axes(Arguments& command, TradeRequest& request);
// Adds --error, whose value take_measure reads.
void add_error_measure(Arguments& command, std::string& name);
// Sets the measure of this name, or the task's own where it is empty.
void take_measure(const std::string& name, TradeRequest& request);

}  // namespace touchstone
