// The points of the cores at a normal, and the balance of those that tie: the multipliers of
// smooth_foot.h.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/narrow_phase/smooth/smooth_foot.h"

namespace touchstone {
namespace {

// Kinks this near to a normal (radians) belong to it.
constexpr double kink_width = 1e-9;

Vec3d unit_across(const Vec3d& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  return n.cross(Vec3d::Unit(least)).normalized();
}

// The points of a core with this normal.
SmoothFace face_at(const SmoothCore& core, const Vec3d& n) {
  SmoothFace face;
  face.furthest = core.furthest(n);
  face.middle = face.furthest.point;
  if (core.has_disc() && !face.furthest.is_tip &&
      face.furthest.reach <= kink_width * core.radius()) {
    face.kind = SmoothFace::Kind::disc;
    const bool down = core.is_cone() || core.edge(2).dot(n) < 0;
    face.middle = down ? Vec3d(-core.edge(2)) : core.edge(2);
    face.first = core.edge(0);
    face.second = core.edge(1);
  } else if (core.has_tie() && std::abs(core.angle_to_tie(n)) <= kink_width) {
    face.kind = SmoothFace::Kind::tie;
    if (core.is_cone()) {
      // Both ends, whichever is further by rounding.
      SmoothPoint& rim = face.furthest;
      if (rim.is_tip) {
        const double x = core.edge(0).dot(n), y = core.edge(1).dot(n);
        const double reach = std::max(rim.reach, 1e-140);
        rim.is_tip = false;
        rim.point = (x / reach) * core.edge(0) + (y / reach) * core.edge(1) - core.edge(2);
        rim.turn = (x / reach) * core.edge(1) - (y / reach) * core.edge(0);
      }
      face.first = 0.5 * (core.edge(2) - rim.point);
      face.middle = 0.5 * (core.edge(2) + rim.point);
    } else {
      face.first = core.edge(2);
      face.middle = face.furthest.point - (core.edge(2).dot(n) < 0 ? -1 : 1) * core.edge(2);
    }
  }
  return face;
}

double length_of_shares(const SmoothFace& face) {
  return std::sqrt(face.first_share * face.first_share + face.second_share * face.second_share);
}

// Chooses the shares, of least squares, that leave no slide, and returns what they leave. A core whose shares exceed 1 keeps
// those of length 1, and the other core takes the rest.
double balance(const SmoothPair& pair, SmoothFoot& foot) {
  const Vec3d& n = foot.normal;
  const Vec3d u = unit_across(n), v = n.cross(u);
  const Vec3d base = foot.a.middle + foot.b.middle + pair.offset;
  std::array<bool, 2> kept{};
  const std::array<SmoothFace*, 2> faces{&foot.a, &foot.b};
  for (int round = 0; round < 2; ++round) {
    Vec3d from = base;
    double uu = 0, uv = 0, vv = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const SmoothFace& face = *faces[k];
      if (kept[k]) {
        from += face.point() - face.middle;
        continue;
      }
      for (const Vec3d& g : {face.first, face.second}) {
        const double x = g.dot(u), y = g.dot(v);
        uu += x * x;
        uv += x * y;
        vv += y * y;
      }
    }
    const double x = -from.dot(u), y = -from.dot(v);
    const double trace = uu + vv, determinant = uu * vv - uv * uv;
    double p = 0, q = 0;  // the least-squares multiplier: shares are generators times this
    if (determinant > 1e-9 * trace * trace) {
      p = (vv * x - uv * y) / determinant;
      q = (uu * y - uv * x) / determinant;
    } else if (trace > 0) {
      // One direction only: that of the matrix's longer column.
      const double cx = uu > vv ? uu : uv, cy = uu > vv ? uv : vv;
      const double along = (cx * x + cy * y) / ((cx * cx + cy * cy) * trace);
      p = along * cx;
      q = along * cy;
    } else {
      break;
    }
    bool again = false;
    for (std::size_t k = 0; k < 2; ++k) {
      SmoothFace& face = *faces[k];
      if (kept[k]) continue;
      face.first_share = face.first.dot(u) * p + face.first.dot(v) * q;
      face.second_share = face.second.dot(u) * p + face.second.dot(v) * q;
      const double length = length_of_shares(face);
      if (length <= 1) continue;
      face.first_share /= length;
      face.second_share /= length;
      kept[k] = again = true;
    }
    if (!again) break;
  }
  foot.nearest = pair.offset;
  double off = 0;  // by how much the kinks miss the normal
  for (SmoothFace* face : faces) {
    foot.nearest += face->point();
    face->slack = std::max(0.0, 1 - length_of_shares(*face));
    off += std::abs(face->first.dot(n)) + std::abs(face->second.dot(n));
  }
  const double along = n.dot(foot.nearest);
  foot.held = along - off;
  foot.slide = std::sqrt((foot.nearest - along * n).squaredNorm());
  return foot.slide;
}

}  // namespace

double make_foot(const SmoothPair& pair, const Vec3d& normal, SmoothFoot& foot) {
  foot.normal = normal;
  foot.a = face_at(pair.a, normal);
  foot.b = face_at(pair.b, normal);
  foot.height = foot.a.furthest.height + foot.b.furthest.height + normal.dot(pair.offset);
  ++foot.support_calls;
  return balance(pair, foot);
}

}  // namespace touchstone
