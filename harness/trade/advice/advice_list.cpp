// Reads a list of scenes for advice.
#include "harness/trade/advice/advice_list.h"

#include <fmt/format.h>

#include <array>
#include <set>
#include <string_view>

#include "harness/files/folders/folder_name.h"
#include "harness/files/toml_table.h"

namespace touchstone::trade {
namespace {

AdviceTask read_task(files::TomlTable& table, const std::filesystem::path& folder,
                     const TradeRequest& usual) {
  AdviceTask task;
  TradeRequest& request = task.request = usual;
  request.scene = (folder / table.text("file")).lexically_normal();
  if (!std::filesystem::is_regular_file(request.scene)) {
    table.fail("file", fmt::format("found \"{}\", which is no file; expected a scene",
                                   request.scene.string()));
  }
  task.name = files::folder_name(table, request.scene);
  request.name = files::folder_name(table, request.scene, "-advice");
  request.task =
      static_cast<Task>(table.choice("task", traded_tasks, static_cast<std::size_t>(usual.task)));
  request.measure = static_cast<ErrorMeasure>(table.choice(
      "error", error_measure_names, static_cast<std::size_t>(default_measure(request.task))));
  task.budget.most = table.number("max_error", files::not_negative, task.budget.most);
  task.budget.no_false_negatives = table.boolean("no_false_negatives", false);
  table.finish();
  return task;
}

}  // namespace

std::vector<AdviceTask> read_advice_list(const std::filesystem::path& file,
                                         const TradeRequest& usual) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  std::vector<AdviceTask> tasks;
  std::set<std::string> names;
  for (files::TomlTable& table : top.tables("scene")) {
    tasks.push_back(read_task(table, file.parent_path(), usual));
    if (!names.insert(tasks.back().name).second) {
      table.fail("name", fmt::format("\"{}\" is there twice; expected another name for one of them",
                                     tasks.back().name));
    }
  }
  top.finish();
  return tasks;
}

}  // namespace touchstone::trade
