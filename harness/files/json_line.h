// Files of JSON objects, one per line, with error messages that give the place of a wrong value.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "algorithms/core/vec.h"
#include "harness/base/error.h"

namespace touchstone::files {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

// A value in a line of the file, with its path, which is built only for an error message.
class JsonNode {
 public:
  JsonNode(const std::string& file, std::int64_t line, const Json& value)
      : file_(file), line_(line), value_(value) {}
  JsonNode(const JsonNode&) = delete;  // children point to their parent
  JsonNode& operator=(const JsonNode&) = delete;

  [[noreturn]] void fail(const std::string& message) const {
    const std::string way = path();
    throw base::InputError(file_, line_, way.empty() ? message : way + ": " + message);
  }

  const std::string& file() const { return file_; }
  std::int64_t line() const { return line_; }
  const Json& value() const { return value_; }
  std::size_t size() const { return value_.size(); }
  bool has(const char* key) const { return value_.contains(key); }

  // A required member; `expected` describes it.
  JsonNode at(const char* key, std::string_view expected) const {
    const auto member = value_.find(key);
    if (member == value_.end()) fail(fmt::format("no \"{}\"; expected {}", key, expected));
    return {*this, *member, key, 0};
  }
  JsonNode operator[](std::size_t index) const { return {*this, value_[index], nullptr, index}; }

  const JsonNode& as_object(std::string_view expected) const {
    if (!value_.is_object()) fail(fmt::format("found {}; expected {}", found(), expected));
    return *this;
  }
  const JsonNode& as_array(std::string_view expected) const {
    if (!value_.is_array()) fail(fmt::format("found {}; expected {}", found(), expected));
    return *this;
  }
  double number() const {
    if (!value_.is_number()) fail(fmt::format("found {}; expected a number", found()));
    return value_.get<double>();
  }
  double size_number() const {
    const double size = number();
    if (size < 0) fail(fmt::format("found {}; expected a number >= 0", found()));
    return size;
  }
  const std::string& text(std::string_view expected) const {
    const std::string* const string = value_.get_ptr<const std::string*>();
    if (string == nullptr) fail(fmt::format("found {}; expected {}", found(), expected));
    return *string;
  }
  template <std::size_t size>
  std::array<double, size> numbers(double (JsonNode::*read)() const = &JsonNode::number) const {
    if (!value_.is_array() || value_.size() != size) {
      fail(fmt::format("found {}; expected an array of {} numbers", found(), size));
    }
    std::array<double, size> all;
    for (std::size_t i = 0; i < size; ++i) all[i] = ((*this)[i].*read)();
    return all;
  }
  Vec3d vector(double (JsonNode::*read)() const = &JsonNode::number) const {
    return Vec3d(numbers<3>(read).data());
  }

  // The value for a message: as written if it is short.
  std::string found() const {
    if (value_.is_array()) return fmt::format("an array of {}", value_.size());
    if (value_.is_object()) return "an object";
    const std::string text = value_.dump();
    return text.size() <= 40 ? text : fmt::format("a {}", value_.type_name());
  }

 private:
  JsonNode(const JsonNode& parent, const Json& value, const char* key, std::size_t index)
      : file_(parent.file_),
        line_(parent.line_),
        value_(value),
        parent_(&parent),
        key_(key),
        index_(index) {}

  std::string path() const {
    if (parent_ == nullptr) return "";
    const std::string above = parent_->path();
    if (key_ == nullptr) return fmt::format("{}[{}]", above, index_);
    return above.empty() ? key_ : above + "." + key_;
  }

  const std::string& file_;
  std::int64_t line_;
  const Json& value_;
  const JsonNode* parent_ = nullptr;
  const char* key_ = nullptr;
  std::size_t index_ = 0;
};

// Calls `each` for every line that is not blank, in order. Throws InputError if the file cannot be
// read, as a LineReader does, or has no such line, and if a line is not JSON. A file whose name ends in ".zst" is
// unpacked on the way. `what` names the objects in messages.
void for_each_json_line(const std::filesystem::path& file, std::string_view what,
                        const std::function<void(const JsonNode&)>& each);

}  // namespace touchstone::files
