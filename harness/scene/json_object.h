// Reads the JSON of imported scenes, with messages that name the object.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "algorithms/core/vec.h"

namespace touchstone::scene {

// Reads a file. Throws InputError if it cannot be read, and the line where it is malformed.
// `expected` describes what it should be, for the message.
nlohmann::json parse_json(const std::filesystem::path& file, const std::string& expected);

// One JSON object, with its name for messages. A null counts as absent. Each read throws InputError
// for a value of another type.
class JsonObject {
 public:
  using Json = nlohmann::json;

  JsonObject(const Json& object, std::string file, std::string where);

  [[noreturn]] void fail(const std::string& message) const;
  const Json* find(const char* key) const;
  double number(const char* key, double fallback) const;
  bool boolean(const char* key, bool fallback) const;
  std::string text(const char* key, const char* fallback) const;
  Vec3d vector(const char* key, const Vec3d& fallback) const;
  Vec3d to_vector(const Json& value, const char* key) const;

 private:
  const Json* object_;
  std::string file_, where_;
};

}  // namespace touchstone::scene
