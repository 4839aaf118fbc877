// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <embree3/rtcore.h>

#include <algorithm>
#include <new>

#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {
namespace {

template <typename T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  void* place = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
  if (place == nullptr) throw std::bad_alloc();
  return static_cast<T*>(place);
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

bool cast_in(RTCScene scene, Vec3 o, Vec3 d, float far, int first_id, Hit& hit) {
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  RTCRayHit r{};
  r.ray.org_x = float(o.x), r.ray.org_y = float(o.y), r.ray.org_z = float(o.z);
  r.ray.dir_x = float(d.x), r.ray.dir_y = float(d.y), r.ray.dir_z = float(d.z);
  r.ray.tnear = 0.01F, r.ray.tfar = far, r.ray.mask = ~0U;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = {double(r.ray.tfar), first_id + int(r.hit.geomID), r.hit.primID, double(r.hit.u), double(r.hit.v)};
  return true;
}

}  // namespace

// Two scenes, since a library built without ray masks would ignore them silently.
struct RayCaster::Scene {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene solid = rtcNewScene(device);
  RTCScene hair = rtcNewScene(device);
  bool has_hair = false;
  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    rtcReleaseScene(hair);
    rtcReleaseScene(solid);
    rtcReleaseDevice(device);
  }
};

RayCaster::RayCaster() : scene_(std::make_unique<Scene>()) {
  rtcSetSceneBuildQuality(scene_->hair, RTC_BUILD_QUALITY_MEDIUM);
}
RayCaster::~RayCaster() = default;

void RayCaster::add(const Mesh& mesh) {
  RTCGeometry g = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points =
      new_buffer<std::array<float, 3>>(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.points.size());
  std::ranges::copy(mesh.points, points);
  auto* corners = new_buffer<std::array<std::uint32_t, 3>>(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                           mesh.triangles.size());
  std::ranges::copy(mesh.triangles, corners);
  attach(scene_->solid, g);
}

void RayCaster::add(const Strands& strands) {
  RTCGeometry g = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE);
  auto* nodes = new_buffer<Strands::Node>(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, strands.nodes.size());
  std::ranges::copy(strands.nodes, nodes);
  auto* pieces = new_buffer<std::uint32_t>(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, strands.pieces.size());
  std::ranges::copy(strands.pieces, pieces);
  scene_->has_hair = true;
  attach(scene_->hair, g);
}

void RayCaster::commit() {
  rtcCommitScene(scene_->solid);
  rtcCommitScene(scene_->hair);
}

bool RayCaster::cast(Vec3 origin, Vec3 direction, Hit& hit, Against against) const {
  bool found = cast_in(scene_->solid, origin, direction, float(kFar), 0, hit);
  if (against == Against::Everything && scene_->has_hair) {
    const double far = found ? hit.distance_mm : kFar;
    found |= cast_in(scene_->hair, origin, direction, float(far), kFirstStrands, hit);
  }
  return found;
}

bool RayCaster::blocked(Vec3 origin, Vec3 direction, double far_mm) const {
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  RTCRay r{};
  r.org_x = float(origin.x), r.org_y = float(origin.y), r.org_z = float(origin.z);
  r.dir_x = float(direction.x), r.dir_y = float(direction.y), r.dir_z = float(direction.z);
  r.tnear = 0.05F, r.tfar = float(far_mm), r.mask = ~0U;
  rtcOccluded1(scene_->solid, &context, &r);
  return r.tfar < 0;
}

}  // namespace relievo::hal::sim
