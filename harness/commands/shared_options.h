// Options, results folders and choices of algorithms that several commands share.
#pragma once

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

const Arguments::Choices<Task>& task_choices();
// Those of a trade, whose error is that of a distance or of a depth.
const Arguments::Choices<Task>& trade_task_choices();
// These, and that of concave phases.
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

// Adds the options of the commands that run narrow phases on generated cases in many processes.
// `folder` is the results folder's default name, `work` is the subject that --resume continues.
template <class Request>
void add_case_options(Arguments& command, Request& request, std::string& narrow, std::string& out,
                      const std::string& folder, const std::string& work) {
  command.text("--narrow", narrow, "Narrow phases: names, all, ours, peers, none").show_default();
  command.some_of("--scalar", request.scalars, scalar_choices(),
                  "What is calculated in (default: both)");
  command.number("--seed", request.seed, "The seed of the cases").show_default();
  command.number("--threads", request.workers, "Processes that share the work")
      .within(1, 256)
      .show_default();
  add_time_limit(command, request.time_limit).show_default();
  command.text("--out", out,
               "Folder for the results (default: results/local/" + folder + " in the project)");
  command.flag("--resume", request.resume, "Go on with the " + work + " in this folder");
}

// Returns the folder `out`; if that is empty, results/local/PREFIXNAME in the project. Throws
// InputError if the name cannot be that of a folder (base::name_fault).
std::filesystem::path results_folder(const std::string& out, const std::string& name,
                                     const std::string& prefix = "");

// Says that work which --resume continues was interrupted; returns the exit status.
int end_interrupted();

// Throws InputError if one of these options was given. `expected` says where it may be, such as "with
// --task distance alone".
void expect_not_given(std::initializer_list<Option> options, const std::string& expected);

// Adds --plan and --shard.
Option add_shard(Arguments& command, std::string& plan, std::int64_t& shard);

// Prints a line for each of the first failures of an algorithm, and the number of the others;
// `name_of` names an item.
void print_failures(std::string_view algorithm, std::span<const process::IsolationFailure> failures,
                    const std::function<std::string(std::size_t)>& name_of);

}  // namespace touchstone::commands
