// Used by Embree's rays and point queries: a triangle mesh in a scene of Embree's.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

#include "algorithms/core/mesh/triangle_mesh.h"

namespace touchstone {

// Copies the mesh, rounded to floats, into the scene, which is to be committed then. Triangles keep their numbers.
inline void attach_mesh(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[3 * i + k] = static_cast<float>(mesh.vertices[i][static_cast<int>(k)]);
    }
  }
  auto* const triangles = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::ranges::copy(mesh.triangles[i], triangles + 3 * i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);  // the scene holds it
}

}  // namespace touchstone
