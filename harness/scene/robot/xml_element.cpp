// Reads elements and attributes of XML.
#include "harness/scene/robot/xml_element.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/warning.h"

namespace touchstone::scene {

void XmlElement::fail(const std::string& message) const {
  throw base::InputError(*file_, line(), fmt::format("<{}>: {}", name(), message));
}

void XmlElement::warn(const std::string& message) const {
  base::warn(*file_, line(), fmt::format("<{}>: {}", name(), message));
}

std::int64_t XmlElement::line() const { return element_->GetLineNum(); }

std::string XmlElement::name() const { return base::shortened(element_->Name()); }

std::vector<XmlElement> XmlElement::children(const char* name) const {
  std::vector<XmlElement> found;
  for (const tinyxml2::XMLElement* at = element_->FirstChildElement(name); at != nullptr;
       at = at->NextSiblingElement(name)) {
    found.emplace_back(at, file_);
  }
  return found;
}

std::optional<XmlElement> XmlElement::child(const char* name) const {
  const std::vector<XmlElement> found = children(name);
  if (found.size() > 1) found[1].fail("found twice here; expected it once");
  return found.empty() ? std::nullopt : std::optional(found.front());
}

XmlElement XmlElement::required(const char* name) const {
  const std::optional<XmlElement> found = child(name);
  if (!found) fail(fmt::format("no <{}> in it; expected one", name));
  return *found;
}

bool XmlElement::has(const char* attribute) const {
  return element_->Attribute(attribute) != nullptr;
}

const char* XmlElement::value(const char* attribute) const {
  const char* found = element_->Attribute(attribute);
  if (found == nullptr) fail(fmt::format("no attribute {}; expected one", attribute));
  return found;
}

std::string XmlElement::text(const char* attribute) const { return value(attribute); }

double XmlElement::finite(const char* attribute, const std::string& word) const {
  double x = 0;
  // A sign + is allowed in XML's numbers.
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, x);
  if (error != std::errc() || end != last || !std::isfinite(x)) {
    fail(fmt::format("{}: found \"{}\"; expected a finite number", attribute,
                     base::shortened(word)));
  }
  return x;
}

double XmlElement::number(const char* attribute, std::optional<double> fallback) const {
  if (fallback && !has(attribute)) return *fallback;
  std::istringstream words(value(attribute));
  std::string word, rest;
  words >> word;
  if (words >> rest) fail(fmt::format("{}: found several numbers; expected one", attribute));
  return finite(attribute, word);
}

Vec3d XmlElement::vector(const char* attribute, std::optional<Vec3d> fallback) const {
  if (fallback && !has(attribute)) return *fallback;
  std::istringstream words(value(attribute));
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(finite(attribute, word));
  if (numbers.size() != 3) {
    fail(fmt::format("{}: found {} numbers; expected three", attribute, numbers.size()));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

XmlFile::XmlFile(const std::filesystem::path& file, const char* root)
    : file_(file.string()), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text =
      base::read_whole(file, base::longest_text, fmt::format("XML with <{}>", root));
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw base::InputError(file_, document_->ErrorLineNum(),
                           fmt::format("malformed XML ({})", document_->ErrorName()));
  }
  const tinyxml2::XMLElement* top = document_->RootElement();
  if (top == nullptr) throw base::InputError(file_, 0, "no element; expected XML");
  if (std::string_view(top->Name()) != root) {
    XmlElement(top, &file_).fail(fmt::format("expected <{}>", root));
  }
}

XmlFile::~XmlFile() = default;

XmlElement XmlFile::root() const { return {document_->RootElement(), &file_}; }

}  // namespace touchstone::scene
