// Options, results folders and choices of algorithms that several commands share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/commands/arguments.h"
#include "harness/process/isolate.h"
#include "harness/record/query_task.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {

// Those of a trade, whose error is that of a distance or of a depth.
const Arguments::Choices<Task>& trade_task_choices();
// Those of every narrow phase, and of concave phases.
const Arguments::Choices<record::QueryTask>& run_task_choices();
const Arguments::Choices<Precision>& scalar_choices();
const Arguments::Choices<scene::BoxKind>& box_choices();

// Adds --count and --seed of a generated scene.
void add_scene_overrides(Arguments& command, scene::SceneOverrides& overrides);
// Adds --time-limit in seconds.
Option add_time_limit(Arguments& command, double& seconds,
                      const std::string& help = "Seconds that a query may take");
// Adds --depth-error of tables.
Option add_depth_error(Arguments& command, double& error);
// Adds --threads of an executor.
Option add_threads(Arguments& command, int& threads, const std::string& help = "Threads");
const Arguments::Choices<ExecutorKind>& executor_choices();

// Returns the folder `out`; if that is empty, results/local/PREFIXNAME in the project. Throws
// InputError if the name cannot be that of a folder (base::name_fault).
std::filesystem::path results_folder(const std::string& out, const std::string& name,
                                     const std::string& prefix = "");

// The file in which a results folder keeps the text with which its work ended.
inline constexpr std::string_view summary_file = "summary.txt";
// Writes that file for `show`. A file of somebody else by that name stays.
void keep_summary(const std::filesystem::path& folder, const std::string& text);
// Prints the text, and keeps it.
void print_summary(const std::filesystem::path& folder, const std::string& text);

// Says that work which --resume continues was interrupted; returns the exit status.
int end_interrupted();

// Adds --peer, which may stand several times.
Option add_peer(Arguments& command, std::vector<std::string>& peers);
// Adds these peers to the registry, to be asked for so many repeats of each question if it is not 0. Returns the names of
// their entries, joined by commas.
std::string start_peers(const std::vector<std::string>& peers, std::int64_t repeat = 0);
// The times that peers measured themselves; empty if no question was repeated.
std::string repeats_text();
// Returns both lists of names, joined by commas, without an empty one.
std::string joined_names(const std::string& names, const std::string& further);

// Throws InputError if one of these words, joined by commas, is not the file of a module.
void expect_module_files(const std::string& words);

// Throws InputError if one of these options was given. `expected` says where it may be, such as "with
// --task distance alone".
void expect_not_given(std::initializer_list<Option> options, const std::string& expected);

// Adds --plan and --shard.
Option add_shard(Arguments& command, std::string& plan, std::int64_t& shard);

}  // namespace touchstone::commands
