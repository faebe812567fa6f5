// Reads PLY (Turk, "The PLY Polygon File Format", 1994) as text or binary in either byte order.
// Elements other than vertex and face, and properties other than x, y, z and the list of vertex
// indices, are ignored.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "harness/geometry/mesh_format.h"

namespace touchstone::geometry {
namespace {

enum class Encoding { text, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count_type;  // set for a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

Type read_type(TextCursor& cursor) {
  static constexpr std::pair<std::string_view, Type> names[] = {
      {"char", Type::int8},      {"uchar", Type::uint8},    {"short", Type::int16},
      {"ushort", Type::uint16},  {"int", Type::int32},      {"uint", Type::uint32},
      {"float", Type::float32},  {"double", Type::float64}, {"int8", Type::int8},
      {"uint8", Type::uint8},    {"int16", Type::int16},    {"uint16", Type::uint16},
      {"int32", Type::int32},    {"uint32", Type::uint32},  {"float32", Type::float32},
      {"float64", Type::float64}};
  const std::string_view token = cursor.token();
  for (const auto& [name, type] : names) {
    if (token == name) return type;
  }
  cursor.fail("expected a PLY type such as uchar, int or float");
}

Header read_header(TextCursor& cursor) {
  Header header;
  bool has_format = false;
  if (!cursor.next_line() || cursor.token() != "ply") cursor.fail("expected 'ply'");
  while (true) {
    if (!cursor.next_line()) cursor.fail("the file ends early; expected 'end_header'");
    const std::string_view keyword = cursor.token();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      const std::string_view name = cursor.token();
      has_format = true;
      if (name == "ascii") {
        header.encoding = Encoding::text;
      } else if (name == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (name == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else {
        cursor.fail("expected format ascii, binary_little_endian or binary_big_endian");
      }
    } else if (keyword == "element") {
      const std::string name(cursor.token());
      const std::int64_t count = cursor.integer();
      if (count < 0) cursor.fail("expected an element count of zero or more");
      header.elements.push_back({name, count, {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("expected 'element' before the first 'property'");
      Property property;
      TextCursor ahead = cursor;
      if (ahead.token() == "list") {
        cursor.token();
        property.count_type = read_type(cursor);
      }
      property.type = read_type(cursor);
      property.name = cursor.token();
      header.elements.back().properties.push_back(std::move(property));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      cursor.fail("expected format, element, property, comment or end_header");
    }
  }
  if (!has_format) cursor.fail("expected 'format' before 'end_header'");
  return header;
}

template <class T>
double value_of(std::uint64_t bits) {
  if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  } else if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<double>(bits);
  } else {
    return static_cast<double>(static_cast<T>(bits));
  }
}

// The numbers after the header, in order.
class Body {
 public:
  Body(std::string file, Encoding encoding, TextCursor cursor, std::string_view bytes)
      : file_(std::move(file)), encoding_(encoding), cursor_(std::move(cursor)), bytes_(bytes) {
    at_ = bytes.size() - cursor_.rest_of_file().size();
  }

  double next(Type type) {
    if (encoding_ == Encoding::text) {
      return cursor_.to_number(cursor_.token_across_lines("another number"));
    }
    switch (type) {
      case Type::int8: return value_of<std::int8_t>(bits(1));
      case Type::uint8: return value_of<std::uint8_t>(bits(1));
      case Type::int16: return value_of<std::int16_t>(bits(2));
      case Type::uint16: return value_of<std::uint16_t>(bits(2));
      case Type::int32: return value_of<std::int32_t>(bits(4));
      case Type::uint32: return value_of<std::uint32_t>(bits(4));
      case Type::float32: return value_of<float>(bits(4));
      case Type::float64: return value_of<double>(bits(8));
    }
    return 0;
  }
  // Passes a number that nobody needs, which may be infinite or NaN.
  void skip(Type type) {
    if (encoding_ != Encoding::text) {
      next(type);
      return;
    }
    const std::string_view token = cursor_.token_across_lines("another number");
    double value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error == std::errc::invalid_argument || end != token.data() + token.size()) {
      cursor_.fail("expected a number");
    }
  }
  // The next number as a count or an index: a whole number >= 0.
  std::int64_t next_whole(Type type) {
    const double value = next(type);
    if (!(value >= 0 && value <= 0xffffffffp0 && value == std::floor(value))) {
      fail("expected a count or an index, zero or more");
    }
    return static_cast<std::int64_t>(value);
  }
  [[noreturn]] void fail(const std::string& message) const {
    if (encoding_ == Encoding::text) cursor_.fail(message);
    throw base::InputError(file_, 0, message + ", before byte " + std::to_string(at_));
  }

 private:
  std::uint64_t bits(std::size_t size) {
    if (bytes_.size() - at_ < size) fail("the file ends early; expected another number");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = encoding_ == Encoding::big_endian ? i : size - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes_[at_ + from]);
    }
    at_ += size;
    return value;
  }

  std::string file_;
  Encoding encoding_;
  TextCursor cursor_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

void read_vertices(Body& body, const Element& element, Mesh& mesh) {
  int found = 0;
  for (const Property& p : element.properties) {
    found += !p.count_type && (p.name == "x" || p.name == "y" || p.name == "z");
  }
  if (found != 3) body.fail("expected the vertex properties x, y and z, once each");
  for (std::int64_t i = 0; i < element.count; ++i) {
    Vec3d v = Vec3d::Zero();
    for (const Property& p : element.properties) {
      const std::int64_t count = p.count_type ? body.next_whole(*p.count_type) : 1;
      for (std::int64_t k = 0; k < count; ++k) {
        if (p.count_type || p.name.size() != 1 || p.name[0] < 'x' || p.name[0] > 'z') {
          body.skip(p.type);
          continue;
        }
        const double value = body.next(p.type);
        if (!std::isfinite(value)) body.fail("expected finite coordinates");
        v[p.name[0] - 'x'] = value;
      }
    }
    mesh.vertices.push_back(v);
  }
}

// Reads faces, and elements to be ignored.
void read_others(Body& body, const Element& element, Mesh& mesh) {
  if (element.properties.empty()) return;
  std::vector<std::uint32_t> polygon;
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (const Property& p : element.properties) {
      const std::int64_t count = p.count_type ? body.next_whole(*p.count_type) : 1;
      const bool is_polygon = element.name == "face" && p.count_type &&
                              (p.name == "vertex_indices" || p.name == "vertex_index");
      polygon.clear();
      for (std::int64_t k = 0; k < count; ++k) {
        if (is_polygon) {
          polygon.push_back(static_cast<std::uint32_t>(body.next_whole(p.type)));
        } else {
          body.skip(p.type);
        }
      }
      add_fan(mesh, polygon);
    }
  }
}

}  // namespace

Mesh read_ply(const std::string& file, std::string_view text) {
  TextCursor cursor(file, text);
  const Header header = read_header(cursor);
  Body body(file, header.encoding, cursor, text);
  Mesh mesh;
  for (const Element& element : header.elements) {
    if (element.name == "tristrips") body.fail("triangle strips are not read; expected faces");
    if (element.name == "vertex") {
      read_vertices(body, element, mesh);
    } else {
      read_others(body, element, mesh);
    }
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t index : triangle) {
      if (index >= mesh.vertices.size()) {
        body.fail("vertex index " + std::to_string(index) + " out of range; there are " +
                  std::to_string(mesh.vertices.size()) + " vertices, from 0");
      }
    }
  }
  return mesh;
}

}  // namespace touchstone::geometry
