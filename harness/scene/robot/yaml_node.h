// Reads YAML strictly, through yaml-cpp: every fault is reported with file and line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/core/pose.h"

namespace touchstone::scene {

class YamlNode {
 public:
  YamlNode(YAML::Node node, std::string file) : node_(std::move(node)), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& message) const;
  std::int64_t line() const { return node_.Mark().line + 1; }

  bool is_list() const { return node_.IsSequence(); }

  // Warns of each key of a map that is nearly one of these, since what was meant is not read.
  void warn_of_slips(std::initializer_list<std::string_view> keys) const;
  // What a map has for a key, where it is neither absent nor empty. Throws if this is no map.
  std::optional<YamlNode> find(const char* key) const;
  YamlNode required(const char* key) const;
  // The elements of a list, or those of the list for a key; of no key: none.
  std::vector<YamlNode> elements() const;
  std::vector<YamlNode> elements(const char* key) const;

  std::string text() const;
  double number() const;  // finite
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  // So many finite numbers: a list, or a map with these keys.
  std::vector<double> numbers(const std::vector<const char*>& keys) const;
  std::vector<std::string> texts(const char* key) const;
  // {position, orientation} or {translation, rotation}, with quaternions (x, y, z, w) of any length but 0.
  Pose pose() const;

 private:
  YAML::Node node_;
  std::string file_;
};

// Throws InputError if the file cannot be read or is not YAML.
YamlNode read_yaml(const std::filesystem::path& file, const std::string& expected);

}  // namespace touchstone::scene
