// Options, results folders and choices of algorithms.
#include "harness/commands/shared_options.h"

#include "harness/base/data_folder.h"
#include "harness/base/enumerators.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/base/error.h"
#include "harness/base/names.h"
#include "harness/commands/commands.h"
#include "harness/files/text_file.h"
#include "harness/kinds/selection.h"
#include "harness/modules/file_word.h"
#include "harness/record/folder_files.h"

namespace touchstone::commands {

const Arguments::Choices<record::QueryTask>& run_task_choices() {
  static const Arguments::Choices<record::QueryTask> choices = [] {
    Arguments::Choices<record::QueryTask> all;
    for (const record::QueryTask task : base::enumerators<record::QueryTask>) {
      all.emplace_back(to_string(task), task);
    }
    return all;
  }();
  return choices;
}

const Arguments::Choices<Task>& trade_task_choices() {
  static const Arguments::Choices<Task> choices = {{"intersect", Task::intersect},
                                                   {"distance", Task::distance},
                                                   {"penetration", Task::penetration}};
  return choices;
}

const Arguments::Choices<Precision>& scalar_choices() {
  static const Arguments::Choices<Precision> choices = {{"float", Precision::float32},
                                                        {"double", Precision::float64}};
  return choices;
}

const Arguments::Choices<scene::BoxKind>& box_choices() {
  static const Arguments::Choices<scene::BoxKind> choices = {{"tight", scene::BoxKind::tight},
                                                             {"loose", scene::BoxKind::loose}};
  return choices;
}

const Arguments::Choices<ExecutorKind>& executor_choices() {
  static const Arguments::Choices<ExecutorKind> choices = {{"crew", ExecutorKind::crew},
                                                           {"onetbb", ExecutorKind::onetbb}};
  return choices;
}

void add_scene_overrides(Arguments& command, scene::SceneOverrides& overrides) {
  command.number("--count", overrides.count, "Bodies of a generated scene").positive();
  command.number("--seed", overrides.seed, "Seed of a generated scene").not_negative();
}

Option add_time_limit(Arguments& command, double& seconds, const std::string& help) {
  return command.number("--time-limit", seconds, help).positive();
}

Option add_depth_error(Arguments& command, double& error) {
  return command
      .number("--depth-error", error,
              "Greatest error of a distance or depth that is right, as a part of the pair's size")
      .positive()
      .show_default();
}

Option add_threads(Arguments& command, int& threads, const std::string& help) {
  return command.number("--threads", threads, help).within(1, 1024).show_default();
}

Option add_peer(Arguments& command, std::vector<std::string>& peers) {
  return command
      .texts("--peer", peers,
             "Also ask a program behind a pipe (results/peer_protocol.md): its command, or an "
             "adapter of datasets/adapters, NAME, NAME@VERSION or NAME@all; it may stand several "
             "times")
      .once_each();
}

std::string joined_names(const std::string& names, const std::string& further) {
  return names + (names.empty() || further.empty() ? "" : ",") + further;
}

Option add_shard(Arguments& command, std::string& plan, std::int64_t& shard) {
  Option folder = command.text("--plan", plan, "Folder of a plan, of which one shard is done");
  const Option number =
      command.number("--shard", shard, "Number of the shard, from 0").not_negative().needs(folder);
  return folder.needs(number);
}

void expect_module_files(const std::string& words) {
  if (words.empty()) return;
  for (const std::string& word : kinds::split_names(words)) {
    if (modules::is_file(word)) continue;
    throw base::InputError(fmt::format(
        "--with: found '{}'; expected the file of a module, such as ./libmine.so", word));
  }
}

void expect_not_given(std::initializer_list<Option> options, const std::string& expected) {
  for (const Option& option : options) {
    if (!option.given()) continue;
    throw base::InputError(fmt::format("{} was given; expected it {}", option.name(), expected));
  }
}

std::filesystem::path results_folder(const std::string& out, const std::string& name,
                                     const std::string& prefix) {
  const std::string fault = base::name_fault(name);
  if (!fault.empty()) throw base::InputError("the name of the work: " + fault);
  if (!out.empty()) return out;
  const base::DataFolder& data = base::data_folder();
  const std::filesystem::path above = data.is_installed ? std::filesystem::path() : data.path;
  return above / "results/local" / (prefix + name);
}

void keep_summary(const std::filesystem::path& folder, const std::string& text) {
  const std::filesystem::path file = folder / summary_file;
  std::error_code error;
  record::OwnFiles own(folder);
  if (std::filesystem::exists(std::filesystem::symlink_status(file, error)) &&
      !own.has(std::string(summary_file))) {
    fmt::print(stderr, "touchstone: {} is not of this program, and stays as it is\n",
               file.string());
    return;
  }
  own.note({file});  // The list comes first: a kill then leaves no file that is not listed.
  files::write_text(file, text);
}

void print_summary(const std::filesystem::path& folder, const std::string& text) {
  fmt::print("{}", text);
  keep_summary(folder, text);
}

int end_interrupted() {
  fmt::print(stderr,
             "touchstone: interrupted; what was done until then is kept, and --resume goes on with "
             "it\n");
  return exit_bad_request;
}

}  // namespace touchstone::commands
