// Reads pairs with their answers, and adds what is exact.
#include "harness/report/recorded_pairs.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/packed_files.h"
#include "harness/kinds/pair/reproducer/reproducer.h"
#include "harness/report/body_view.h"
#include "harness/report/case_view.h"

namespace touchstone::report {
namespace {

using files::JsonNode;
using files::OrderedJson;

constexpr const char* file_name = "wrong_pairs.jsonl";

const std::string& text_of(const JsonNode& node, const char* key) {
  return node.at(key, "a text").text("a text");
}

// A number or a vector that is not known is null.
OrderedJson number_of(const JsonNode& node, const char* key) {
  return node.has(key) ? number(node.at(key, "a number").number()) : OrderedJson();
}
OrderedJson triple_of(const JsonNode& node, const char* key) {
  return node.has(key) ? triple(node.at(key, "three numbers").vector()) : OrderedJson();
}

// The grade in the words of the page.
std::string_view grade_of(const JsonNode& answer) {
  const std::string& grade = text_of(answer, "grade");
  if (grade == "right") return "right";
  if (grade == "wrong") return "silent";
  if (grade == "gave_up") return "honest";
  if (grade == "failed") return text_of(answer, "status") == "timed_out" ? "hung" : "crashed";
  answer.at("grade", "")
      .fail(fmt::format("found '{}'; expected right, wrong, gave_up or failed", grade));
}

OrderedJson answer_of(const JsonNode& answer) {
  const std::string_view grade = grade_of(answer);
  const double error = answer.at("error", "a number").number();
  return {{"algorithm", text_of(answer, "algorithm")},
          {"origin", "peer"},
          {"scalar", text_of(answer, "scalar")},
          {"task", text_of(answer, "task")},
          {"answer", text_of(answer, "answer")},
          {"status", text_of(answer, "status")},
          {"distance", number_of(answer, "distance")},
          {"lower", nullptr},
          {"upper", nullptr},
          {"normal", triple_of(answer, "normal")},
          {"witness_a", triple_of(answer, "on_a")},
          {"witness_b", triple_of(answer, "on_b")},
          {"grade", grade},
          {"why", grade == "silent" ? fmt::format("off by {:.2g} of the size", error) : ""}};
}

// The test of an algorithm that has such a form; empty if it has none, or not for this pair.
std::string test_of(const std::string& algorithm, const files::Case& c, const std::string& task,
                    const std::string& file) {
  if (file.empty()) return "";
  for (const Task one :
       {Task::intersect, Task::distance, Task::penetration, Task::signed_distance}) {
    if (to_string(one) != task) continue;
    try {
      return kinds::reproducer(algorithm, std::vector{c}, one, file);
    } catch (const base::InputError&) {
      return "";  // it does not take such shapes
    }
  }
  return "";
}

OrderedJson recorded_of(const JsonNode& line, const files::Case& c) {
  OrderedJson answers = OrderedJson::array(), tests = OrderedJson::array();
  const JsonNode given = line.at("answers", "an array of answers");
  given.as_array("an array of answers");
  for (std::size_t i = 0; i < given.size(); ++i) {
    answers.push_back(answer_of(given[i].as_object("an answer")));
    const OrderedJson& answer = answers.back();
    if (answer["grade"] != "silent") continue;
    const std::string algorithm = answer["algorithm"], task = answer["task"];
    const std::string file = kinds::reproducer_file(algorithm);
    std::string text = test_of(algorithm, c, task, file);
    if (text.empty()) continue;
    tests.push_back({{"algorithm", algorithm}, {"file", file}, {"text", std::move(text)}});
  }
  return {{"group", text_of(line, "group")},
          {"answers", std::move(answers)},
          {"tests", std::move(tests)}};
}

}  // namespace

OrderedJson recorded_pair_views(const std::filesystem::path& folder, double time_limit) {
  const std::filesystem::path file = files::row_file(folder / file_name);
  if (!std::filesystem::exists(file)) return OrderedJson::array();
  const std::vector<files::Case> cases = files::read_cases(file);
  std::vector<OrderedJson> recorded;
  files::for_each_json_line(file, "a case", [&](const JsonNode& line) {
    recorded.push_back(recorded_of(line, cases[recorded.size()]));
  });
  std::vector<ListedCase> listed;
  for (const files::Case& c : cases)
    listed.push_back({.c = c, .file = file.filename().string(), .about = c.id});
  OrderedJson views = case_views(listed, folder, time_limit);
  for (std::size_t i = 0; i < recorded.size(); ++i) views[i]["recorded"] = std::move(recorded[i]);
  return views;
}

}  // namespace touchstone::report
