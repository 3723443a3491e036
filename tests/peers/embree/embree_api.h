// The few declarations of Embree 4's C interface that this program calls, written down by hand because
// the wheel holds the library without headers. Layouts are those of 4.x; `main` refuses other versions.
#pragma once

#include <cstddef>
#include <sys/types.h>

using Device = struct DeviceHandle*;
using Scene = struct SceneHandle*;
using Geometry = struct GeometryHandle*;

enum : int {
    PROPERTY_MAJOR = 1,
    PROPERTY_MINOR = 2,
    PROPERTY_PATCH = 3,
    PROPERTY_NATIVE_16 = 34,
    GEOMETRY_TRIANGLE = 0,
    BUFFER_INDEX = 0,
    BUFFER_VERTEX = 1,
    FORMAT_UINT3 = 0x5003,
    FORMAT_FLOAT3 = 0x9003,
    QUALITY_LOW = 0,
    QUALITY_MEDIUM = 1,
    QUALITY_HIGH = 2,
    SCENE_NONE = 0,
    SCENE_COMPACT = 1 << 1,
    SCENE_ROBUST = 1 << 2,
    QUERY_INCOHERENT = 0,
    QUERY_COHERENT = 1 << 16,
};

constexpr unsigned NO_ID = 0xffffffffu;

// One layout serves single rays (W = 1) and packets: arrays of W, aligned to their width.
constexpr std::size_t aligned_to(int width) { return width < 4 ? 16 : 4 * static_cast<std::size_t>(width); }

template <int W>
struct alignas(aligned_to(W)) Ray {
    float org_x[W], org_y[W], org_z[W], tnear[W];
    float dir_x[W], dir_y[W], dir_z[W], time[W];
    float tfar[W];
    unsigned mask[W], id[W], flags[W];
};

template <int W>
struct alignas(aligned_to(W)) Hit {
    float normal_x[W], normal_y[W], normal_z[W], u[W], v[W];
    unsigned triangle[W], geometry[W], instance[W];
    // Written only by builds with instance arrays; room for it is right for both kinds.
    unsigned instance_part[W];
};

template <int W>
struct RayHit {
    Ray<W> ray;
    Hit<W> hit;
};

static_assert(sizeof(Ray<1>) == 48 && sizeof(Ray<16>) == 768 && alignof(RayHit<16>) == 64);
static_assert(offsetof(RayHit<1>, hit) == 48 && offsetof(RayHit<16>, hit) == 768);

// The same for intersection and occlusion. All zero but these two means the defaults.
struct Query {
    int flags;
    unsigned features = 0xffffffffu;
    void* context = nullptr;
    void* filter = nullptr;
    void* callback = nullptr;
    // Read only by builds with a minimum curve width.
    float min_width = 0;
};

extern "C" {
Device rtcNewDevice(const char* config);
ssize_t rtcGetDeviceProperty(Device, int property);
int rtcGetDeviceError(Device);
void rtcReleaseDevice(Device);

Geometry rtcNewGeometry(Device, int type);
void rtcSetSharedGeometryBuffer(Geometry, int buffer, unsigned slot, int format, const void* data,
                                std::size_t offset, std::size_t stride, std::size_t items);
void rtcSetGeometryBuildQuality(Geometry, int quality);
void rtcCommitGeometry(Geometry);
void rtcReleaseGeometry(Geometry);

Scene rtcNewScene(Device);
void rtcSetSceneFlags(Scene, int flags);
void rtcSetSceneBuildQuality(Scene, int quality);
unsigned rtcAttachGeometry(Scene, Geometry);
void rtcCommitScene(Scene);
void rtcReleaseScene(Scene);

void rtcIntersect1(Scene, RayHit<1>*, Query*);
void rtcIntersect8(const int* valid, Scene, RayHit<8>*, Query*);
void rtcIntersect16(const int* valid, Scene, RayHit<16>*, Query*);
void rtcOccluded1(Scene, Ray<1>*, Query*);
void rtcOccluded8(const int* valid, Scene, Ray<8>*, Query*);
void rtcOccluded16(const int* valid, Scene, Ray<16>*, Query*);
}
