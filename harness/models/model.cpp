// Reads the stream of touchstone_read_model, in which nothing is trusted, and puts meshes together.
#include "harness/models/model.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/base/reproducible_math.h"
#include "harness/models/model_stream.h"

namespace touchstone::models {

std::string LeftOut::words() const {
  std::string text;
  const auto add = [&](std::uint64_t count, std::string_view one) {
    if (count == 0) return;
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, one, count == 1 ? "" : "s");
  };
  add(lines, "line");
  add(points, "point");
  add(animations, "animation");
  add(cameras, "camera");
  add(lights, "light");
  add(morph_targets, "morph target");
  return text;
}

std::string Model::up() const {
  std::string name;
  for (int axis = 0; axis < 3; ++axis) {
    if (z_up(2, axis) != 0) name = fmt::format("{}{}", z_up(2, axis) < 0 ? "-" : "", "xyz"[axis]);
  }
  return name;
}

namespace {

Affine product(const Affine& outer, const Affine& inner) {
  return {base::product(outer.linear, inner.linear),
          base::times(outer.linear, inner.translation) + outer.translation};
}

class StreamReader {
 public:
  StreamReader(std::string file, std::string_view rest) : file_(std::move(file)), rest_(rest) {}

  Model read() {
    expect(stream_begin);
    Model model;
    model.metres = real();
    if (!(model.metres > 0) || !std::isfinite(model.metres)) {
      fail(fmt::format("a unit of {} m; expected a length above 0", model.metres));
    }
    for (int i = 0; i < 9; ++i) model.z_up(i / 3, i % 3) = real();
    expect_turn(model.z_up);
    const std::size_t meshes = count(16);
    for (std::size_t i = 0; i < meshes; ++i) model.meshes.push_back(mesh(i));
    LeftOut& left = model.left_out;
    for (std::uint64_t* number : {&left.lines, &left.points, &left.animations, &left.cameras,
                                  &left.lights, &left.morph_targets}) {
      *number = bits<std::uint64_t>();
    }
    model.skinned = bits<std::uint64_t>();
    const std::size_t warnings = count(sizeof(std::uint64_t));
    for (std::size_t i = 0; i < warnings; ++i) model.warnings.emplace_back(bytes(count(1)));
    const std::size_t nodes = count(8 + 8 + 12 * sizeof(double) + 8);
    for (std::size_t i = 0; i < nodes; ++i) model.nodes.push_back(node(model));
    expect(stream_end);
    if (!rest_.empty()) lost("has more behind its end");
    expect_triangles(model);
    return model;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw base::InputError(file_, 0, message);
  }
  [[noreturn]] void lost(const std::string& what) const {
    fail("what Assimp made of it " + what + "; expected a whole model");
  }

  std::string_view bytes(std::size_t size) {
    if (size > rest_.size()) lost("ends early");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  void expect(std::string_view text) {
    if (bytes(text.size()) != text) lost("is garbage");
  }
  template <class T>
  T bits() {
    T value;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  double real() { return bits<double>(); }
  // A number of things of which each takes so many bytes at least.
  std::size_t count(std::size_t size_of_one) {
    const auto number = bits<std::uint64_t>();
    if (number > rest_.size() / size_of_one) lost("ends early");
    return number;
  }

  void expect_turn(const Mat3d& m) const {
    bool good = std::abs(m.determinant()) == 1;
    for (int i = 0; i < 9; ++i) {
      const double x = std::abs(m(i / 3, i % 3));
      good = good && (x == 0 || x == 1);
    }
    if (!good) lost("has no axes");
  }

  ModelMesh mesh(std::size_t number) {
    ModelMesh mesh;
    const auto vertices = bits<std::uint64_t>(), triangles = bits<std::uint64_t>();
    if (vertices > rest_.size() / sizeof(Vec3d) || vertices > UINT32_MAX) lost("ends early");
    mesh.vertices.resize(vertices);
    static_assert(sizeof(Vec3d) == 3 * sizeof(double));
    copy(mesh.vertices);
    if (triangles > rest_.size() / sizeof mesh.triangles[0]) lost("ends early");
    mesh.triangles.resize(triangles);
    copy(mesh.triangles);
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t index : triangle) {
        if (index >= vertices) {
          fail(fmt::format("mesh {}: vertex index {} out of range; there are {} vertices, from 0",
                           number, index, vertices));
        }
        if (!mesh.vertices[index].allFinite()) {
          fail(fmt::format("mesh {}: vertex {} is not finite; expected finite coordinates", number,
                           index));
        }
      }
    }
    return mesh;
  }
  template <class T>
  void copy(std::vector<T>& to) {
    const std::string_view from = bytes(to.size() * sizeof(T));
    if (!to.empty()) std::memcpy(static_cast<void*>(to.data()), from.data(), from.size());
  }

  ModelNode node(const Model& model) {
    ModelNode node;
    const auto parent = bits<std::uint64_t>();
    if (parent > model.nodes.size()) lost("has a node before its parent");
    node.name = bytes(count(1));
    Affine own;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) own.linear(row, column) = real();
      own.translation[row] = real();
    }
    node.to_file = parent == 0 ? own : product(model.nodes[parent - 1].to_file, own);
    const std::size_t meshes = count(sizeof(std::uint32_t));
    for (std::size_t i = 0; i < meshes; ++i) {
      const auto index = bits<std::uint32_t>();
      if (index >= model.meshes.size()) lost("has a node with a mesh that is not there");
      node.meshes.push_back(index);
    }
    if (!node.to_file.linear.allFinite() || !node.to_file.translation.allFinite()) {
      fail(fmt::format("node \"{}\": its place is not finite; expected finite numbers",
                       base::shortened(node.name)));
    }
    return node;
  }

  void expect_triangles(const Model& model) const {
    for (const ModelNode& node : model.nodes) {
      for (const std::uint32_t mesh : node.meshes) {
        if (!model.meshes[mesh].triangles.empty()) return;
      }
    }
    const std::string left = model.left_out.words();
    fail(fmt::format("no node has triangles{}; expected some",
                     left.empty() ? "" : " (it has " + left + ")"));
  }

  std::string file_;
  std::string_view rest_;
};

constexpr std::uint32_t none = UINT32_MAX;

}  // namespace

Model parse_model(const std::string& file, std::string_view stream) {
  return StreamReader(file, stream).read();
}

void Joiner::grow() {
  slots_.assign(std::bit_ceil(4 * mesh_.vertices.size() + 64), none);
  for (std::uint32_t i = 0; i < mesh_.vertices.size(); ++i) *slot_of(mesh_.vertices[i]) = i;
}

// The slot of a point, or the free one where it would be.
std::uint32_t* Joiner::slot_of(const Vec3d& point) {
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    hash = base::mix(hash ^ std::bit_cast<std::uint64_t>(point[k] + 0.0));  // -0 is 0
  }
  for (std::size_t at = hash;; ++at) {
    std::uint32_t& slot = slots_[at & (slots_.size() - 1)];
    if (slot == none || mesh_.vertices[slot] == point) return &slot;
  }
}

std::uint32_t Joiner::number_of(const Vec3d& point) {
  if (2 * mesh_.vertices.size() >= slots_.size()) grow();
  std::uint32_t* const slot = slot_of(point);
  if (*slot == none) {
    *slot = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(point);
  }
  return *slot;
}

void Joiner::add(const ModelMesh& mesh, const Affine& place) {
  std::vector<std::uint32_t> numbers(mesh.vertices.size(), none);
  const bool is_mirror = place.linear.determinant() < 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3>& added = mesh_.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& number = numbers[triangle[k]];
      if (number == none) {
        number =
            number_of(base::times(place.linear, mesh.vertices[triangle[k]]) + place.translation);
      }
      added[k] = number;
    }
    if (is_mirror) std::swap(added[1], added[2]);
  }
}

ModelMesh Joiner::take() {
  slots_.clear();
  return std::exchange(mesh_, {});
}

void expect_few(const std::string& file, const Model& model) {
  std::size_t triangles = 0;
  for (const ModelNode& node : model.nodes) {
    for (const std::uint32_t mesh : node.meshes) triangles += model.meshes[mesh].triangles.size();
    if (triangles <= most_triangles) continue;
    throw base::InputError(
        file, 0,
        fmt::format("its instances have more than {} triangles; expected at most so many",
                    most_triangles));
  }
}

ModelMesh whole_mesh(const std::string& file, const Model& model) {
  expect_few(file, model);
  Joiner joiner;
  for (const ModelNode& node : model.nodes) {
    const Affine place = {model.metres * node.to_file.linear,
                          model.metres * node.to_file.translation};
    for (const std::uint32_t mesh : node.meshes) joiner.add(model.meshes[mesh], place);
  }
  ModelMesh whole = joiner.take();
  for (const Vec3d& v : whole.vertices) {
    if (v.allFinite()) continue;
    throw base::InputError(file, 0,
                           "a vertex is not finite at its place; expected a smaller model");
  }
  return whole;
}

}  // namespace touchstone::models
