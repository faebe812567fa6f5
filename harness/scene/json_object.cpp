// Reads JSON objects.
#include "harness/scene/json_object.h"

#include <algorithm>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"

namespace touchstone::scene {

nlohmann::json parse_json(const std::filesystem::path& file, const std::string& expected) {
  const std::string text = base::read_whole(file, base::longest_text, expected);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    throw base::InputError(file.string(), 1 + std::count(text.begin(), end, '\n'),
                           std::string("malformed JSON (") + e.what() + ")");
  } catch (const nlohmann::json::exception& e) {  // for example a number that no double can hold
    throw base::InputError(file.string(), 0, std::string("malformed JSON (") + e.what() + ")");
  }
}

JsonObject::JsonObject(const Json& object, std::string file, std::string where)
    : object_(&object), file_(std::move(file)), where_(std::move(where)) {
  if (!object.is_object()) fail("expected an object");
}

void JsonObject::fail(const std::string& message) const {
  throw base::InputError(file_, 0, where_.empty() ? message : where_ + ": " + message);
}

const JsonObject::Json* JsonObject::find(const char* key) const {
  const auto at = object_->find(key);
  return at == object_->end() || at->is_null() ? nullptr : &*at;
}

double JsonObject::number(const char* key, double fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_number()) fail(std::string("'") + key + "': expected a number");
  return value->get<double>();
}

bool JsonObject::boolean(const char* key, bool fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) fail(std::string("'") + key + "': expected true or false");
  return value->get<bool>();
}

std::string JsonObject::text(const char* key, const char* fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_string()) fail(std::string("'") + key + "': expected a text");
  return value->get<std::string>();
}

Vec3d JsonObject::vector(const char* key, const Vec3d& fallback) const {
  const Json* value = find(key);
  return value == nullptr ? fallback : to_vector(*value, key);
}

Vec3d JsonObject::to_vector(const Json& value, const char* key) const {
  if (value.is_array() && value.size() == 2) {
    fail(std::string("'") + key + "' has two coordinates; expected a three-dimensional scene");
  }
  if (!value.is_array() || value.size() != 3 ||
      !std::all_of(value.begin(), value.end(), [](const Json& c) { return c.is_number(); })) {
    fail(std::string("'") + key + "': expected three numbers");
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

}  // namespace touchstone::scene
