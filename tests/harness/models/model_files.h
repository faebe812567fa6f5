// Small models as texts and bytes, all of one tetrahedron.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::model_files {

// A tetrahedron with sides of 1, 2 and 3 along the axes, its triangles anticlockwise from outside. Its volume is 1.
inline constexpr std::array<float, 12> points = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
inline constexpr std::array<std::uint16_t, 12> corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
inline const std::string obj =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline const std::string buffer = bytes_of(points) + bytes_of(corners);

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

inline std::string data_uri(std::string_view bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

// glTF of these nodes (JSON), of which the first `roots` are in the scene. Mesh 0 is the tetrahedron. An empty uri is
// that of a GLB. `more` is further JSON of the file, with a comma in front.
inline std::string gltf(const std::string& nodes, const std::string& uri = data_uri(buffer),
                        const std::string& roots = "0", const std::string& more = "",
                        const std::string& mode = "4") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + roots +
         R"(]}], "nodes": [)" + nodes +
         R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": )" +
         mode + R"(}]}], "accessors": [
{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 3]},
{"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}], "bufferViews": [
{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
"buffers": [{"byteLength": 72)" +
         (uri.empty() ? "" : ", \"uri\": \"" + uri + "\"") + "}]" + more + "}";
}

inline std::string glb(std::string json, std::string binary = buffer) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

// COLLADA of these nodes; `asset` may have a unit and an axis. The geometry is "#t".
inline std::string collada(const std::string& asset, const std::string& nodes) {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         asset + R"(</asset>
<library_geometries><geometry id="t"><mesh><source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)" +
         nodes +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}
inline const std::string collada_node =
    "<node id=\"one\" name=\"one\"><translate>1 2 3</translate><instance_geometry "
    "url=\"#t\"/></node>";

// A property of FBX, such as {"Lcl Translation", "1,2,3"}.
struct Property {
  std::string name, value;
};
inline std::string fbx_properties(const std::vector<Property>& properties) {
  std::string text = "\t\tProperties70:  {\n";
  for (const auto& [name, value] : properties) {
    const std::string type = name.starts_with("Lcl")                ? name
                             : name == "UnitScaleFactor"            ? "double"
                             : value.find(',') == std::string::npos ? "int"
                                                                    : "Vector3D";
    text += "\t\t\tP: \"" + name + "\", \"" + type + "\", \"\", \"A\"," + value + "\n";
  }
  return text + "\t\t}\n";
}

// FBX in text: the node "part" with these properties, and in it the node "kid" at (10, 0, 0).
inline std::string fbx(const std::vector<Property>& part, const std::vector<Property>& settings) {
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: "
         "1003\n\tFBXVersion: "
         "7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n" +
         fbx_properties(settings) +
         "}\nDefinitions:  {\n\tVersion: 100\n\tCount: 2\n\tObjectType: \"Model\" {\n\t\tCount: "
         "2\n\t}\n\tObjectType: \"Geometry\" {\n\t\tCount: 1\n\t}\n}\nObjects:  {\n\tGeometry: 10, "
         "\"Geometry::tet\", \"Mesh\" {\n\t\tVertices: *12 {\n\t\t\ta: "
         "0,0,0,1,0,0,0,2,0,0,0,3\n\t\t}\n\t\tPolygonVertexIndex: *12 {\n\t\t\ta: "
         "0,2,-2,0,1,-4,0,3,-3,1,2,-4\n\t\t}\n\t}\n\tModel: 20, \"Model::part\", \"Mesh\" "
         "{\n\t\tVersion: 232\n" +
         fbx_properties(part) + "\t}\n\tModel: 21, \"Model::kid\", \"Mesh\" {\n\t\tVersion: 232\n" +
         fbx_properties({{"Lcl Translation", "10,0,0"}}) +
         "\t}\n}\nConnections:  {\n\tC: \"OO\",20,0\n\tC: \"OO\",21,20\n\tC: \"OO\",10,20\n\tC: "
         "\"OO\",10,21\n}\n";
}

inline std::string chunk(std::uint16_t id, const std::string& content) {
  return bytes_of(id) + bytes_of(static_cast<std::uint32_t>(6 + content.size())) + content;
}

// 3DS of the tetrahedron, moved by (1, 2, 3), which is where its frame is too.
inline std::string three_ds() {
  std::string vertices = bytes_of(std::uint16_t{4}), faces = bytes_of(std::uint16_t{4});
  constexpr std::array<float, 3> at = {1, 2, 3};
  for (std::size_t i = 0; i < points.size(); ++i) vertices += bytes_of(points[i] + at[i % 3]);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    faces += bytes_of(corners[i]) + (i % 3 == 2 ? std::string(2, '\0') : "");
  }
  const std::array<float, 12> frame = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 2, 3};
  const std::string mesh = chunk(
      0x4100, chunk(0x4110, vertices) + chunk(0x4160, bytes_of(frame)) + chunk(0x4120, faces));
  return chunk(0x4d4d, chunk(0x0002, bytes_of(std::uint32_t{3})) +
                           chunk(0x3d3d, chunk(0x4000, std::string("part\0", 5) + mesh)));
}

}  // namespace touchstone::model_files
