// touchstone_read_model FILE BYTES SECONDS: reads a model by Assimp with so much memory and time, and writes it as
// model_stream.h says.
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/BaseImporter.h>
#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/models/model_stream.h"

#if defined(__SANITIZE_ADDRESS__)
// A crash is to end the process by its signal, as without the sanitizer. What Assimp leaks is its own.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_abort=0:handle_sigfpe=0:handle_sigill=0:detect_"
         "leaks=0:"
         "allocator_may_return_null=1";
}
#endif

namespace {

using namespace touchstone::models;

// Standard output; its end is exit_read alone.
class Stream {
 public:
  void bytes(const void* data, std::size_t size) {
    if (std::fwrite(data, 1, size, stdout) != size) std::_Exit(exit_cannot_read);
  }
  void count(std::uint64_t value) { bytes(&value, sizeof value); }
  void real(double value) { bytes(&value, sizeof value); }
  void index(std::uint32_t value) { bytes(&value, sizeof value); }
  void text(std::string_view value) { bytes(value.data(), value.size()); }
};

// The frame of a file: its unit, and the turn from its axes to z up.
struct Frame {
  double metres = 1;
  std::array<double, 9> z_up = {1, 0, 0, 0, 0, -1, 0, 1, 0};  // y is up
};

constexpr std::array<double, 9> of_z_up = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// The decimal number with the fewest digits that rounds to the float: what the file says.
double as_written(float value) {
  for (int digits = 1; digits <= 9; ++digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, double{value});
    if (std::strtof(text.data(), nullptr) == value) return std::strtod(text.data(), nullptr);
  }
  return value;
}

// Assimp's reader of COLLADA makes the root node a uniform scale by the unit and a turn to y up.
Frame frame_of_collada(aiMatrix4x4& root) {
  const float unit = std::max({std::abs(root.a1), std::abs(root.a2), std::abs(root.a3)});
  const auto is = [&](std::array<float, 9> turn) {
    const float* const rows[3] = {&root.a1, &root.b1, &root.c1};
    for (std::size_t i = 0; i < 9; ++i) {
      if (rows[i / 3][i % 3] != unit * turn[i]) return false;
    }
    return true;
  };
  Frame frame;
  frame.metres = as_written(unit);
  if (is({1, 0, 0, 0, 0, 1, 0, -1, 0})) {
    frame.z_up = of_z_up;
  } else if (is({0, -1, 0, 1, 0, 0, 0, 0, 1})) {
    // The file's x points up, its z to the viewer, and its negative y to the right.
    frame.z_up = {0, -1, 0, 0, 0, -1, 1, 0, 0};
  } else if (!is({1, 0, 0, 0, 1, 0, 0, 0, 1})) {
    throw std::runtime_error(
        "the unit and the axis that points up are not those of a COLLADA file");
  }
  root = aiMatrix4x4();
  return frame;
}

// Assimp leaves the coordinates of FBX as they are. The unit is in centimetres.
Frame frame_of_fbx(const aiScene& scene) {
  const auto number = [&](const char* key, int fallback) {
    int value = fallback;
    if (scene.mMetaData != nullptr) scene.mMetaData->Get(key, value);
    return value;
  };
  Frame frame;
  float scale = 1;
  double wide = 1;
  if (scene.mMetaData != nullptr && scene.mMetaData->Get("UnitScaleFactor", scale)) {
    frame.metres = as_written(scale) / 100;
  } else if (scene.mMetaData != nullptr && scene.mMetaData->Get("UnitScaleFactor", wide)) {
    frame.metres = wide / 100;
  } else {
    frame.metres = 0.01;
  }
  const std::array<int, 3> axes = {number("CoordAxis", 0), number("FrontAxis", 2),
                                   number("UpAxis", 1)};
  const std::array<int, 3> signs = {number("CoordAxisSign", 1), number("FrontAxisSign", 1),
                                    number("UpAxisSign", 1)};
  frame.z_up.fill(0);
  std::set<int> used;
  for (std::size_t row = 0; row < 3; ++row) {
    if (axes[row] < 0 || axes[row] > 2 || std::abs(signs[row]) != 1 ||
        !used.insert(axes[row]).second) {
      throw std::runtime_error("the axes in GlobalSettings are not three axes, each once");
    }
    // To the right is x, to the front negative y, up z.
    frame.z_up[3 * row + static_cast<std::size_t>(axes[row])] = row == 1 ? -signs[row] : signs[row];
  }
  return frame;
}

// The coordinates of 3DS have z up; Assimp's reader turns its root node to y up.
Frame frame_of_3ds(aiMatrix4x4& root) {
  root = aiMatrix4x4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1) * root;
  Frame frame;
  frame.z_up = of_z_up;
  return frame;
}

void write_mesh(const aiMesh& mesh, std::array<std::uint64_t, 2>& lines_and_points, Stream& out) {
  std::uint64_t triangles = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    switch (mesh.mFaces[i].mNumIndices) {
      case 1: ++lines_and_points[1]; break;
      case 2: ++lines_and_points[0]; break;
      case 3: ++triangles; break;
      default: break;
    }
  }
  out.count(mesh.mNumVertices);
  out.count(triangles);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const std::array<double, 3> wide = {v.x, v.y, v.z};
    out.bytes(wide.data(), sizeof wide);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices == 3) out.bytes(face.mIndices, 3 * sizeof(std::uint32_t));
  }
}

void write_node(const aiNode& node, std::uint64_t parent, Stream& out) {
  out.count(parent);
  out.count(node.mName.length);
  out.bytes(node.mName.data, node.mName.length);
  const aiMatrix4x4& m = node.mTransformation;
  for (const float x : {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4}) {
    out.real(x);
  }
  out.count(node.mNumMeshes);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) out.index(node.mMeshes[i]);
}

void write_nodes(const aiNode* root, Stream& out) {
  std::vector<std::pair<const aiNode*, std::uint64_t>> nodes;
  if (root != nullptr) nodes.emplace_back(root, 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const aiNode* const node = nodes[i].first;
    for (unsigned k = 0; k < node->mNumChildren; ++k) nodes.emplace_back(node->mChildren[k], i + 1);
  }
  out.count(nodes.size());
  for (const auto& [node, parent] : nodes) write_node(*node, parent, out);
}

std::string ending_of(std::string_view file) {
  std::string ending(file.substr(std::min(file.size(), file.rfind('.') + 1)));
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// What a list or an object of JSON has there; null where there is nothing.
nlohmann::json at(const nlohmann::json& node, const char* key) {
  return node.is_object() ? node.value(key, nlohmann::json()) : nlohmann::json();
}

// Whether positions are no floats. Assimp takes their bytes for floats.
bool has_other_positions(const nlohmann::json& json) {
  constexpr int of_float = 5126;
  const nlohmann::json accessors = at(json, "accessors");
  for (const auto& mesh : at(json, "meshes")) {
    for (const auto& primitive : at(mesh, "primitives")) {
      const nlohmann::json position = at(at(primitive, "attributes"), "POSITION");
      if (!position.is_number_unsigned() || !accessors.is_array()) continue;
      const auto number = position.get<std::size_t>();
      if (number < accessors.size() && at(accessors[number], "componentType") != of_float)
        return true;
    }
  }
  return false;
}

// Assimp skips extensions of glTF that it does not know. A file that needs one would be read wrong.
void refuse_extensions(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t header = 20;  // of the file and of its first chunk
  if (text.starts_with("glTF") && text.size() >= header) {
    std::uint32_t size = 0;
    std::memcpy(&size, text.data() + 12, sizeof size);
    text = text.substr(header, size);
  }
  const auto json = nlohmann::json::parse(text, nullptr, false);
  const auto names = [&](const char* key) {
    std::vector<std::string> found;
    if (!json.is_object() || !json.contains(key) || !json[key].is_array()) return found;
    for (const auto& name : json[key]) {
      if (name.is_string()) found.push_back(name.get<std::string>());
    }
    return found;
  };
  const auto refuse = [](const std::string& name) {
    throw std::runtime_error("the file needs the extension " + name +
                             " of glTF, which is not read");
  };
  for (const std::string& name : names("extensionsRequired")) {
    if (!name.starts_with("KHR_materials_") && !name.starts_with("KHR_texture_") &&
        !name.starts_with("EXT_texture_") && name != "KHR_lights_punctual" &&
        name != "KHR_draco_mesh_compression") {
      refuse(name);
    }
  }
  for (const std::string& name : names("extensionsUsed")) {
    if (name == "EXT_mesh_gpu_instancing") refuse(name);
  }
  if (has_other_positions(json)) refuse("KHR_mesh_quantization");
}

// What Assimp says while it reads. It goes on after an index out of range, without the face or with another index.
class Said : public Assimp::LogStream {
 public:
  void write(const char* message) override {
    std::string text = message;
    text.erase(0, text.find(": ") + 2);  // its level and thread
    while (text.ends_with('\n')) text.pop_back();
    if (has_one(text, {"out of range", "out-of-range", "index overflow"})) {
      if (fault.empty()) fault = text;
    } else if (has_one(text, {"Unable to find geometry", "Unable to resolve", "source object"}) &&
               warnings.size() < most) {
      warnings.insert(text);
    }
  }

  std::string fault;               // the first that makes the model another one
  std::set<std::string> warnings;  // of what is left out since it is not there

 private:
  static constexpr std::size_t most = 10;
  static bool has_one(const std::string& text, std::initializer_list<const char*> parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const char* part) { return text.find(part) != std::string::npos; });
  }
};

// Keeps the readers of the ending alone; the others would be tried too.
void keep_readers(Assimp::Importer& importer, const std::string& ending) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::set<std::string> endings;
    importer.GetImporter(i)->GetExtensionList(endings);
    if (!endings.contains(ending)) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

void read(const std::string& file) {
  const std::string ending = ending_of(file);
  const bool is_gltf = ending == "gltf" || ending == "glb";
  if (is_gltf) refuse_extensions(file);
  Assimp::Importer importer;
  keep_readers(importer, ending);
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
  auto* const said = new Said;  // the logger's from here on
  Assimp::DefaultLogger::get()->attachStream(said, Assimp::Logger::Warn | Assimp::Logger::Err);
  // Normals and the like would part corners of equal coordinates.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_TEXTURES);
  // Otherwise Assimp does not invert the post-rotation, and children inherit geometric transforms.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  aiScene* const scene = const_cast<aiScene*>(  // the root node is to be changed
      importer.ReadFile(file, aiProcess_RemoveComponent | aiProcess_Triangulate));
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string error = importer.GetErrorString();
    if (error.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw std::runtime_error(error.empty() ? "it says not why" : error);
  }
  if (!said->fault.empty()) throw std::runtime_error(said->fault);
  aiMatrix4x4& root = scene->mRootNode->mTransformation;
  const Frame frame = ending == "dae"   ? frame_of_collada(root)
                      : ending == "fbx" ? frame_of_fbx(*scene)
                      : ending == "3ds" ? frame_of_3ds(root)
                                        : Frame{};
  Stream out;
  out.text(stream_begin);
  out.real(frame.metres);
  for (const double x : frame.z_up) out.real(x);
  out.count(scene->mNumMeshes);
  std::array<std::uint64_t, 2> lines_and_points{};
  std::uint64_t skinned = 0, targets = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    write_mesh(mesh, lines_and_points, out);
    skinned += mesh.mNumBones > 0 ? 1 : 0;
    targets += mesh.mNumAnimMeshes;
  }
  for (const std::uint64_t count :
       {lines_and_points[0], lines_and_points[1], std::uint64_t{scene->mNumAnimations},
        std::uint64_t{scene->mNumCameras}, std::uint64_t{scene->mNumLights}, targets, skinned}) {
    out.count(count);
  }
  out.count(said->warnings.size());
  for (const std::string& warning : said->warnings) {
    out.count(warning.size());
    out.text(warning);
  }
  write_nodes(scene->mRootNode, out);
  out.text(stream_end);
  if (std::fflush(stdout) != 0) std::_Exit(exit_cannot_read);
}

// A limit is not set under the sanitizer, which maps terabytes.
void set_limits(const char* bytes, const char* seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_DUMPABLE, 0);  // no core dump
  const auto set = [](auto what, const char* text) {
    const rlim_t most = std::strtoull(text, nullptr, 10);
    const rlimit limit{.rlim_cur = most, .rlim_max = most};
    setrlimit(what, &limit);
  };
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  set(RLIMIT_AS, bytes);
#else
  static_cast<void>(bytes);
#endif
  set(RLIMIT_CPU, seconds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("touchstone reads models by this program, which takes FILE BYTES SECONDS\n", stderr);
    return exit_cannot_read;
  }
  set_limits(argv[2], argv[3]);
  try {
    read(argv[1]);
  } catch (const std::bad_alloc&) {
    std::_Exit(exit_no_memory);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s", error.what());
    std::fflush(stderr);
    std::_Exit(exit_cannot_read);
  }
  std::_Exit(exit_read);  // what Assimp would do to free a large scene is left out
}
