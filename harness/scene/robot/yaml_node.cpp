// Reads nodes of YAML.
#include "harness/scene/robot/yaml_node.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/nearest_name.h"
#include "harness/base/reproducible_math.h"
#include "harness/base/warning.h"

namespace touchstone::scene {
namespace {

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

}  // namespace

void YamlNode::fail(const std::string& message) const {
  throw base::InputError(file_, line(), message);
}

void YamlNode::warn_of_slips(std::initializer_list<std::string_view> keys) const {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) continue;
    const std::string& key = entry.first.Scalar();
    if (const auto meant = base::meant_name(key, {keys.begin(), keys.size()})) {
      base::warn(file_, entry.first.Mark().line + 1,
                 fmt::format("the key \"{}\" is ignored; perhaps \"{}\" was meant",
                             base::shortened(key), *meant));
    }
  }
}

std::optional<YamlNode> YamlNode::find(const char* key) const {
  if (!node_.IsMap()) fail(fmt::format("expected a map with the key {}", key));
  YAML::Node found = node_[key];
  if (!found.IsDefined() || found.IsNull()) return std::nullopt;
  return YamlNode(found, file_);
}

YamlNode YamlNode::required(const char* key) const {
  std::optional<YamlNode> found = find(key);
  if (!found) fail(fmt::format("no key {}; expected one", key));
  return *found;
}

std::vector<YamlNode> YamlNode::elements() const {
  if (!node_.IsSequence()) fail("expected a list");
  std::vector<YamlNode> all;
  for (const YAML::Node& element : node_) all.emplace_back(element, file_);
  return all;
}

std::vector<YamlNode> YamlNode::elements(const char* key) const {
  const std::optional<YamlNode> list = find(key);
  return list ? list->elements() : std::vector<YamlNode>();
}

std::string YamlNode::text() const {
  if (!node_.IsScalar()) fail("expected a text or a number");
  return node_.Scalar();
}

double YamlNode::number() const {
  const std::optional<double> value = parsed<double>(text());
  if (!value || !std::isfinite(*value)) {
    fail(fmt::format("found \"{}\"; expected a finite number", base::shortened(text())));
  }
  return *value;
}

std::int64_t YamlNode::integer(std::int64_t low, std::int64_t high) const {
  const std::optional<std::int64_t> value = parsed<std::int64_t>(text());
  if (!value || *value < low || *value > high) {
    fail(fmt::format("found \"{}\"; expected an integer from {} to {}", base::shortened(text()),
                     low, high));
  }
  return *value;
}

std::vector<double> YamlNode::numbers(const std::vector<const char*>& keys) const {
  std::vector<double> values;
  if (node_.IsMap()) {
    for (const char* key : keys) values.push_back(required(key).number());
    return values;
  }
  for (const YamlNode& element : elements()) values.push_back(element.number());
  if (values.size() != keys.size()) {
    fail(fmt::format("found {} numbers; expected {}", values.size(), keys.size()));
  }
  return values;
}

std::vector<std::string> YamlNode::texts(const char* key) const {
  std::vector<std::string> all;
  for (const YamlNode& element : elements(key)) all.push_back(element.text());
  return all;
}

Pose YamlNode::pose() const {
  warn_of_slips({"position", "orientation", "translation", "rotation"});
  Pose pose;
  const auto either = [&](const char* key, const char* other) {
    const std::optional<YamlNode> found = find(key);
    return found ? found : find(other);
  };
  if (const auto place = either("position", "translation")) {
    const std::vector<double> xyz = place->numbers({"x", "y", "z"});
    pose.translation = {xyz[0], xyz[1], xyz[2]};
  }
  if (const auto turn = either("orientation", "rotation")) {
    const std::vector<double> q = turn->numbers({"x", "y", "z", "w"});
    const std::optional<Mat3d> rotation = base::rotation_of_any({q[3], q[0], q[1], q[2]});
    if (!rotation) turn->fail("found the quaternion 0, 0, 0, 0; expected one that is not zero");
    pose.rotation = *rotation;
  }
  return pose;
}

YamlNode read_yaml(const std::filesystem::path& file, const std::string& expected) {
  const std::string text = base::read_whole(file, base::longest_text, expected);
  try {
    const YAML::Node top = YAML::Load(text);
    YamlNode node(top, file.string());
    if (!top.IsMap()) {
      node.fail(fmt::format("found {}; expected {}: a map of keys",
                            top.IsSequence() ? "a list"
                            : top.IsScalar() ? "a text"
                                             : "nothing",
                            expected));
    }
    return node;
  } catch (const YAML::Exception& e) {
    throw base::InputError(file.string(), e.mark.line + 1,
                           fmt::format("malformed YAML ({})", base::shortened(e.msg)));
  }
}

}  // namespace touchstone::scene
