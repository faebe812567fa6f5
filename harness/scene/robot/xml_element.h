// Reads XML strictly, through tinyxml2: every fault is reported with file and line.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/core/vec.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace touchstone::scene {

// An element of a file that is still open. Reads of attributes throw InputError for a value of another type, and
// without a fallback if the attribute is missing.
class XmlElement {
 public:
  XmlElement(const tinyxml2::XMLElement* element, const std::string* file)
      : element_(element), file_(file) {}

  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message) const;
  std::int64_t line() const;
  std::string name() const;

  // The elements inside, in order: all, or those of a name.
  std::vector<XmlElement> children(const char* name = nullptr) const;
  // The element of this name, of which there is at most one.
  std::optional<XmlElement> child(const char* name) const;
  XmlElement required(const char* name) const;

  bool has(const char* attribute) const;
  std::string text(const char* attribute) const;
  double number(const char* attribute, std::optional<double> fallback = {}) const;
  // Three finite numbers with spaces between them.
  Vec3d vector(const char* attribute, std::optional<Vec3d> fallback = {}) const;

 private:
  const char* value(const char* attribute) const;
  double finite(const char* attribute, const std::string& word) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

class XmlFile {
 public:
  // Throws InputError if the file cannot be read, is not XML, or its outermost element has another name.
  XmlFile(const std::filesystem::path& file, const char* root);
  ~XmlFile();
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  XmlElement root() const;

 private:
  std::string file_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

}  // namespace touchstone::scene
