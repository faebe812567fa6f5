// Parses files of JSON objects line by line.
#include "harness/files/json_line.h"

#include <optional>

#include "harness/base/input_file.h"
#include "harness/files/packed_files.h"

namespace touchstone::files {
namespace {

Json parse_line(const std::string& file, std::int64_t number, std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // The library counts its own lines; its message begins with a name in brackets.
    std::string message = error.what();
    if (const auto end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
    if (message.starts_with("parse error at line 1, ")) message.erase(0, 23);
    throw base::InputError(file, number, "malformed JSON: " + base::shortened(message, 200));
  }
}

}  // namespace

void for_each_json_line(const std::filesystem::path& path, std::string_view what,
                        const std::function<void(const JsonNode&)>& each) {
  const std::string file = path.string();
  LineReader lines(path);
  bool any = false;
  std::int64_t number = 0;
  while (const std::optional<std::string_view> line = lines.next()) {
    ++number;
    const std::string_view text = number == 1 ? base::without_byte_order_mark(*line) : *line;
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) continue;
    const Json value = parse_line(file, number, text);
    any = true;
    each(JsonNode(file, number, value));
  }
  if (!any) {
    throw base::InputError(file, 1, fmt::format("no {}; expected one JSON object a line", what));
  }
}

}  // namespace touchstone::files
