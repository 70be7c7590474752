#include "brdf/render/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace sklar::brdf {
namespace {

constexpr double kOffset = 2e-6;        ///< of a ray's start, over the largest coordinate: 17 steps of single precision
constexpr float kShortOfLight = 1e-4F;  ///< of the way to a point, where nothing blocks

void add_sphere(RTCDevice device, RTCScene target, const Sphere& sphere) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* point = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<float>(sphere.centre(axis));
  point[3] = static_cast<float>(sphere.radius);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(target, geometry);
  rtcReleaseGeometry(geometry);
}

void add_mesh(RTCDevice device, RTCScene target, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh.vertices.size()));
  for (const Vec3& position : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(position(axis));
  }
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) *index++ = static_cast<unsigned>(corner);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(target, geometry);
  rtcReleaseGeometry(geometry);
}

Eigen::AlignedBox3d bounds(const Object& object) {
  Eigen::AlignedBox3d box;
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    box.extend(Vec3(sphere->centre.array() - sphere->radius));
    box.extend(Vec3(sphere->centre.array() + sphere->radius));
  } else {
    for (const Vec3& vertex : std::get<MeshPtr>(object.shape)->vertices) box.extend(vertex);
  }
  return box;
}

RTCRay make_ray(const Vec3& origin, const Vec3& direction, float far) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tfar = far;
  ray.mask = ~0U;
  return ray;
}

/// The point of the sphere next to the one in single precision.
Hit sphere_hit(const Sphere& sphere, const Vec3& near) {
  const Vec3 normal = (near - sphere.centre).normalized();
  return {0, sphere.centre + sphere.radius * normal, normal, normal};
}

Hit mesh_hit(const TriangleMesh& mesh, const RTCHit& hit) {
  const auto& corners = mesh.triangles[hit.primID];
  const double u = hit.u, v = hit.v;
  const auto mix = [&](const std::vector<Vec3>& values) -> Vec3 {
    return (1 - u - v) * values[static_cast<std::size_t>(corners[0])] +
           u * values[static_cast<std::size_t>(corners[1])] + v * values[static_cast<std::size_t>(corners[2])];
  };
  const Vec3 face = area_vector(mesh, hit.primID).normalized();
  const Vec3 smooth = mesh.normals.empty() ? face : mix(mesh.normals);
  const bool usable = smooth.dot(face) > 0;
  return {0, mix(mesh.vertices), face, usable ? smooth.normalized() : face};
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = nullptr;

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

RayScene::RayScene(const Scene& scene) : scene_(scene), embree_(std::make_unique<Embree>()) {
  if (embree_->device == nullptr) throw std::runtime_error("Embree cannot be used on this machine");
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  Eigen::AlignedBox3d box;
  for (const Object& object : scene.objects) {  // the id of a geometry is the index of its object
    box.extend(bounds(object));
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      add_sphere(embree_->device, embree_->scene, *sphere);
    } else {
      add_mesh(embree_->device, embree_->scene, *std::get<MeshPtr>(object.shape));
    }
  }
  // One thread: the tree, and with it which of two triangles a ray through their edge meets, is then always the same.
  tbb::task_arena(1).execute([&] { rtcCommitScene(embree_->scene); });
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE) throw std::runtime_error("Embree could not take the scene");
  if (!box.isEmpty()) {
    radius_ = 0.5 * box.diagonal().norm();
    offset_ = kOffset * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  }
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::closest(const Vec3& origin, const Vec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{make_ray(origin, direction, std::numeric_limits<float>::infinity()), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Object& object = scene_.objects[query.hit.geomID];
  const auto* sphere = std::get_if<Sphere>(&object.shape);
  Hit hit = sphere != nullptr ? sphere_hit(*sphere, origin + static_cast<double>(query.ray.tfar) * direction)
                              : mesh_hit(*std::get<MeshPtr>(object.shape), query.hit);
  hit.object = query.hit.geomID;
  return hit;
}

bool RayScene::blocked(const Vec3& from, const Vec3& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, to - from, 1 - kShortOfLight);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

bool RayScene::blocked_toward(const Vec3& from, const Vec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, direction, std::numeric_limits<float>::infinity());
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

Vec3 RayScene::start(const Hit& hit, const Vec3& direction) const {
  return hit.point + (hit.face_normal.dot(direction) > 0 ? offset_ : -offset_) * hit.face_normal;
}

}  // namespace sklar::brdf
