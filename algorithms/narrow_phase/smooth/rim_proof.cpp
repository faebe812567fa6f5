// The faces that are not proven, kept from point to point.
#include "algorithms/narrow_phase/smooth/rim_proof.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr double rim_rounding = SupportPair<double>::rounding;

bool is_face(const EpaHull<double>& surface, int face) {
  return surface.distance(face) < std::numeric_limits<double>::infinity();
}

}  // namespace

RimProof::RimProof(std::size_t most_faces)
    : vertices_(most_faces), open_(most_faces / faces_a_word + 1), low_(open_.size()) {}

void RimProof::start(const EpaHull<double>& surface, const Rim& rim) {
  rim_ = rim;
  for (std::size_t i = 0; i < words_; ++i) open_[i] = low_[i] = 0;
  words_ = 1;
  surface.all_faces([&](int f) {
    add(surface, f);
    return true;
  });
}

void RimProof::extend(const EpaHull<double>& surface) {
  for (const int f : surface.newest_faces()) add(surface, f);
}

void RimProof::add(const EpaHull<double>& surface, int face) {
  const auto place = static_cast<std::size_t>(face);
  // Words are taken in order.
  words_ = std::max(words_, place / faces_a_word + 1);
  const std::uint64_t bit = std::uint64_t{1} << place % faces_a_word;
  std::uint64_t& low = low_[place / faces_a_word];
  open_[place / faces_a_word] |= bit;
  low &= ~bit;
  const double distance = surface.distance(face);
  const bool is_below = distance < rim_.height + 2 * rim_rounding;
  if (is_below && !(rim_.inside(surface.normal(face), distance) > 0)) low |= bit;
}

void RimProof::measure(const EpaHull<double>& surface, int face) {
  const Vec3d m = surface.normal(face);
  const std::array<Vec3d, 3> corners = surface.points(surface.corners(face));
  const double height =
      std::min({m.dot(corners[0]), m.dot(corners[1]), m.dot(corners[2])}) - rim_rounding;
  vertices_[static_cast<std::size_t>(face)] = {m, height, rim_.inside(m, height)};
}

// The lowest face outside of the rim, by the planes as they are; where none is too low, the proof
// itself.
RimProof::Failure RimProof::failure(const EpaHull<double>& surface) {
  Failure found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < words_; ++i) {
    for (std::uint64_t left = low_[i]; left != 0; left &= left - 1) {
      const int f = static_cast<int>(i * faces_a_word) + std::countr_zero(left);
      const double distance = surface.distance(f);
      if (!is_face(surface, f)) low_[i] &= ~(left & -left);
      if (!(distance < least)) continue;
      least = distance;
      found.face = f;
    }
  }
  if (found.face < 0) return failure_on_rim(surface);
  found.along = surface.normal(found.face);
  return found;
}

RimProof::Failure RimProof::failure_on_rim(const EpaHull<double>& surface) {
  Failure found;
  double worst = 1 - 4 * rim_rounding;
  const double height = rim_.height;
  // Returns false if the normal is not proven.
  const auto holds = [&](int face, const Vec3d& along, double reached) {
    const double square = along.squaredNorm();
    // Most are proven without a root.
    if (reached > 0 && reached * reached >= height * height * square) return true;
    const double length = std::sqrt(square), part = reached / (height * length);
    if (part >= 1 - 4 * rim_rounding) return true;
    if (!(part >= worst)) {
      worst = part;
      found = {face, (1 / length) * along};
    }
    return false;
  };
  const auto crossing_holds = [&](int face, const Vertex& in, const Vertex& out) {
    return holds(face, in.inside * out.normal - out.inside * in.normal,
                 in.inside * out.height - out.inside * in.height);
  };
  const auto open_faces = [&](const auto& visit) {
    for (std::size_t i = 0; i < words_; ++i) {
      for (std::uint64_t left = open_[i]; left != 0; left &= left - 1) {
        const int f = static_cast<int>(i * faces_a_word) + std::countr_zero(left);
        if (!is_face(surface, f) || visit(f)) open_[i] &= ~(left & -left);
      }
    }
  };
  const auto is_open = [&](int f) {
    const auto place = static_cast<std::size_t>(f);
    return (open_[place / faces_a_word] >> place % faces_a_word & 1) != 0;
  };
  open_faces([&](int f) {
    measure(surface, f);
    return false;
  });
  open_faces([&](int f) {
    const Vertex& own = vertices_[static_cast<std::size_t>(f)];
    const bool is_inside = own.inside > 0;
    bool is_proven = is_inside || holds(f, own.normal, own.height);
    for (int k = 0; k < 3; ++k) {
      const int g = surface.neighbour(f, k);
      const Vertex& other = vertices_[static_cast<std::size_t>(g)];
      if ((other.inside > 0) == is_inside) continue;
      // The edge is tested with the face inside, if that is open too.
      if (!is_inside && is_open(g)) continue;
      const bool crossing =
          is_inside ? crossing_holds(f, own, other) : crossing_holds(g, other, own);
      is_proven = is_proven && crossing;
    }
    return is_proven;
  });
  return found;
}

}  // namespace touchstone
