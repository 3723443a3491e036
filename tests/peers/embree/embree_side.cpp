// Embree's side of the shadow benchmark: V at given receivers, and the first hits of camera rays, as
// fast as Embree gives them. README.md has the case file and the commands.

#include "embree_api.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace {

constexpr uint32_t MAGIC = 0x554d4231;
constexpr float PI = 3.14159265358979323846f;
constexpr float LIFT = 1e-4f;
constexpr float LIGHT_END = 1 - 1e-4f;
// Samples are made in blocks of this many, whatever the width of the rays that test them.
constexpr int BLOCK = 16;
// Large enough that the shared counter costs nothing, small enough that both threads end together.
constexpr uint32_t RECEIVERS_AT_ONCE = 64;
constexpr uint32_t CAMERA_RAYS_AT_ONCE = 1024;

[[noreturn]] void fail(const std::string& message) {
    std::fprintf(stderr, "embree_side: %s\n", message.c_str());
    std::exit(1);
}

struct Vec3 {
    float x, y, z;
};

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Two unit vectors across a unit vector `n`.
void across(Vec3 n, Vec3& t, Vec3& s) {
    float sign = std::copysign(1.0f, n.z);
    float a = -1 / (sign + n.z), b = n.x * n.y * a;
    t = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    s = {b, sign + n.y * n.y * a, -n.y};
}

enum class Kind : uint32_t { Sun, Disk, Rect, Sphere };

struct Light {
    Kind kind;
    Vec3 a, b, c;
};

struct Receiver {
    Vec3 position, normal;
};

struct Case {
    Light light;
    uint32_t samples;
    // One float more than the corners need: Embree reads whole 16 bytes at the last one.
    std::vector<float> corners;
    uint32_t triangles;
    std::vector<Receiver> receivers;
    Vec3 eye;
    std::vector<Vec3> camera;
};

class Reader {
public:
    explicit Reader(const char* path) : file(path, std::ios::binary) {
        if (!file) fail(std::string("cannot open ") + path);
    }

    template <class T>
    void into(T* to, size_t count) {
        file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(T)));
        if (!file) fail("the case file is too short");
    }

    void end() {
        if (file.peek() != std::ifstream::traits_type::eof()) fail("the case file is too long");
    }

private:
    std::ifstream file;
};

Case read_case(const char* path) {
    Reader reader(path);
    uint32_t head[8];
    reader.into(head, 8);
    if (head[0] != MAGIC) fail("this is no case file");
    if (head[3] > 3) fail("unknown kind of light");
    if (head[1] == 0 || head[4] == 0) fail("no triangles or no samples");
    Case it;
    it.light.kind = static_cast<Kind>(head[3]);
    it.triangles = head[1];
    it.samples = head[4];
    reader.into(&it.light.a, 3);
    it.corners.resize(9 * static_cast<size_t>(it.triangles) + 1);
    reader.into(it.corners.data(), it.corners.size() - 1);
    it.receivers.resize(head[2]);
    reader.into(it.receivers.data(), it.receivers.size());
    reader.into(&it.eye, 1);
    it.camera.resize(head[5]);
    reader.into(it.camera.data(), it.camera.size());
    reader.end();
    return it;
}

/// A low-discrepancy set, the same for all receivers but for a shift, so that samples cost little.
struct SampleSet {
    std::vector<float> u, v;
    uint32_t count;

    explicit SampleSet(uint32_t count) : count(count) {
        struct Point {
            uint32_t u, v;
        };
        std::vector<Point> points(count);
        for (uint32_t i = 0; i < count; i++) {
            // Sobol's first two dimensions, u by reversing bits, v by its own direction numbers.
            uint32_t u = 0, v = 0, direction = 1u << 31;
            for (uint32_t bits = i, place = 31; bits; bits >>= 1, place--, direction ^= direction >> 1) {
                if (bits & 1) {
                    u |= 1u << place;
                    v ^= direction;
                }
            }
            points[i] = {u, v};
        }
        // Along a Z-curve: what shares a packet then aims at one part of the light.
        auto key = [](Point p) {
            uint64_t k = 0;
            for (int bit = 31; bit >= 0; bit--) k = k << 2 | (p.u >> bit & 1) << 1 | (p.v >> bit & 1);
            return k;
        };
        std::sort(points.begin(), points.end(), [&](Point a, Point b) { return key(a) < key(b); });
        size_t padded = (count + BLOCK - 1) / BLOCK * BLOCK;
        u.resize(padded);
        v.resize(padded);
        for (size_t i = 0; i < padded; i++) {
            u[i] = static_cast<float>(points[std::min<size_t>(i, count - 1)].u) * 0x1p-32f;
            v[i] = static_cast<float>(points[std::min<size_t>(i, count - 1)].v) * 0x1p-32f;
        }
    }
};

uint32_t hash(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

float unit(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Sine and cosine of `turn` whole turns, 0 <= turn < 1, to 3e-7: short, and the compiler makes vectors of it.
inline void circle(float turn, float& sine, float& cosine) {
    // Of half the angle, within a quarter turn to either side of the opposite direction.
    float x = (turn - 0.5f) * PI, q = x * x;
    float s = x * (1 + q * (-1.6666667e-1f + q * (8.3333333e-3f + q * (-1.9841270e-4f + q * (2.7557319e-6f - q * 2.5052108e-8f)))));
    float c = 1 + q * (-0.5f + q * (4.1666667e-2f + q * (-1.3888889e-3f + q * (2.4801587e-5f + q * (-2.7557319e-7f + q * 2.0876757e-9f)))));
    sine = -2 * s * c;
    cosine = 2 * s * s - 1;
}

/// The directions of a block's rays and which of them are above the horizon. A ray to a sun is of length
/// 1 and goes on forever; to a lamp it ends at the sample.
struct alignas(64) Block {
    float x[BLOCK], y[BLOCK], z[BLOCK];
    int valid[BLOCK];
};

/// What is the same for all samples of one receiver.
class Aim {
public:
    Aim(const Light& light, const Receiver& at, uint32_t index) : light(light), at(at) {
        uint32_t h = hash(index);
        shift_u = unit(h);
        shift_v = unit(hash(h ^ 0x9e3779b9u));
        to = light.kind == Kind::Sun ? light.a : light.a - at.position;
        if (light.kind == Kind::Sphere) {
            float square = dot(to, to), radius = light.b.x;
            distance = std::sqrt(square);
            axis = to * (1 / distance);
            float sine = std::min(radius * radius / square, 1.0f);
            depth = sine / (1 + std::sqrt(1 - sine));
            across(axis, t, s);
        } else if (light.kind == Kind::Disk) {
            across(light.b, t, s);
            t = t * light.c.x;
            s = s * light.c.x;
        } else if (light.kind == Kind::Sun) {
            axis = light.a;
            float sine = std::sin(light.b.x / 4);
            depth = 2 * sine * sine;
            across(axis, t, s);
        }
    }

    /// Whether no part of the light is above the receiver's horizon.
    bool all_below() const {
        float centre = dot(to, at.normal);
        switch (light.kind) {
        case Kind::Sun: return centre <= -std::sin(light.b.x / 2);
        case Kind::Disk: return centre + std::hypot(dot(t, at.normal), dot(s, at.normal)) <= 0;
        case Kind::Rect: return centre + std::fabs(dot(light.b, at.normal)) + std::fabs(dot(light.c, at.normal)) <= 0;
        case Kind::Sphere: return centre + light.b.x <= 0;
        }
        return true;
    }

    void block(const SampleSet& set, uint32_t first, Block& out) const {
        switch (light.kind) {
        case Kind::Sun: return fill<Kind::Sun>(set, first, out);
        case Kind::Disk: return fill<Kind::Disk>(set, first, out);
        case Kind::Rect: return fill<Kind::Rect>(set, first, out);
        case Kind::Sphere: return fill<Kind::Sphere>(set, first, out);
        }
    }

    Vec3 origin() const { return at.position + at.normal * LIFT; }

private:
    template <Kind kind>
    void fill(const SampleSet& set, uint32_t first, Block& out) const {
        const float* us = set.u.data() + first;
        const float* vs = set.v.data() + first;
        int left = static_cast<int>(std::min<uint32_t>(set.count - first, BLOCK));
        Vec3 lift = at.normal * LIFT;
        for (int i = 0; i < BLOCK; i++) {
            float u = us[i] + shift_u, v = vs[i] + shift_v;
            u -= u >= 1 ? 1.0f : 0.0f;
            v -= v >= 1 ? 1.0f : 0.0f;
            Vec3 d;
            if constexpr (kind == Kind::Rect) {
                d = to + light.b * (2 * u - 1) + light.c * (2 * v - 1);
            } else {
                float sine, cosine;
                circle(v, sine, cosine);
                if constexpr (kind == Kind::Disk) {
                    float r = std::sqrt(u);
                    d = to + t * (r * cosine) + s * (r * sine);
                } else {
                    // z is how far the cosine is below 1: at a sun's size f32 has too few digits near 1.
                    float z = u * depth, square = z * (2 - z), r = std::sqrt(square);
                    d = axis * (1 - z) + t * (r * cosine) + s * (r * sine);
                    if constexpr (kind == Kind::Sphere) {
                        float radius = light.b.x, inside = radius * radius - distance * distance * square;
                        d = d * (distance * (1 - z) - std::sqrt(std::max(inside, 0.0f)));
                    }
                }
            }
            out.valid[i] = (dot(d, at.normal) > 0) & (i < left) ? -1 : 0;
            if constexpr (kind != Kind::Sun) d = d - lift;
            out.x[i] = d.x;
            out.y[i] = d.y;
            out.z[i] = d.z;
        }
    }

    const Light& light;
    const Receiver& at;
    // To the middle of the light.
    Vec3 to;
    Vec3 axis{}, t{}, s{};
    float distance = 0, depth = 0;
    float shift_u, shift_v;
};

void occluded(const int*, Scene scene, Ray<1>* ray, Query* query) { rtcOccluded1(scene, ray, query); }
void occluded(const int* valid, Scene scene, Ray<8>* ray, Query* query) { rtcOccluded8(valid, scene, ray, query); }
void occluded(const int* valid, Scene scene, Ray<16>* ray, Query* query) { rtcOccluded16(valid, scene, ray, query); }
void intersect(const int*, Scene scene, RayHit<1>* ray, Query* query) { rtcIntersect1(scene, ray, query); }
void intersect(const int* valid, Scene scene, RayHit<8>* ray, Query* query) { rtcIntersect8(valid, scene, ray, query); }
void intersect(const int* valid, Scene scene, RayHit<16>* ray, Query* query) { rtcIntersect16(valid, scene, ray, query); }

template <int W>
void blank(Ray<W>& ray) {
    std::memset(&ray, 0, sizeof ray);
    std::fill(ray.mask, ray.mask + W, NO_ID);
}

/// Tests blocks of samples with rays W at a time. A block whose samples are all above the horizon goes
/// out as it is; what is left of others waits until it fills a packet, so that no lane is wasted on a
/// small number of samples or on a light that the horizon cuts.
template <int W>
class Tester {
public:
    Tester(Scene scene, Query query, float end, uint32_t* seen) : scene(scene), query(query), end(end), seen(seen) {
        blank(ray);
        blank(waiting);
        std::fill(valid, valid + W, -1);
    }

    void block(const Block& block, Vec3 origin, uint32_t receiver) {
        int above = 0;
        for (int i = 0; i < BLOCK; i++) above -= block.valid[i];
        if (above < BLOCK) {
            for (int i = 0; above > 0 && i < BLOCK; i++) {
                if (block.valid[i]) later(block, i, origin, receiver);
            }
            return;
        }
        std::fill(ray.org_x, ray.org_x + W, origin.x);
        std::fill(ray.org_y, ray.org_y + W, origin.y);
        std::fill(ray.org_z, ray.org_z + W, origin.z);
        uint32_t open = 0;
        for (int first = 0; first < BLOCK; first += W) {
            std::copy_n(block.x + first, W, ray.dir_x);
            std::copy_n(block.y + first, W, ray.dir_y);
            std::copy_n(block.z + first, W, ray.dir_z);
            // Embree leaves its verdict here.
            std::fill(ray.tfar, ray.tfar + W, end);
            occluded(valid, scene, &ray, &query);
            for (int i = 0; i < W; i++) open += ray.tfar[i] >= 0;
        }
        seen[receiver] += open;
        rays += BLOCK;
    }

    void flush() {
        if (!held) return;
        alignas(64) int some[W];
        for (int i = 0; i < W; i++) some[i] = i < held ? -1 : 0;
        std::fill(waiting.tfar, waiting.tfar + W, end);
        occluded(some, scene, &waiting, &query);
        for (int i = 0; i < held; i++) seen[owner[i]] += waiting.tfar[i] >= 0;
        rays += static_cast<uint64_t>(held);
        held = 0;
    }

    uint64_t rays = 0;

private:
    void later(const Block& block, int i, Vec3 origin, uint32_t receiver) {
        waiting.org_x[held] = origin.x;
        waiting.org_y[held] = origin.y;
        waiting.org_z[held] = origin.z;
        waiting.dir_x[held] = block.x[i];
        waiting.dir_y[held] = block.y[i];
        waiting.dir_z[held] = block.z[i];
        owner[held] = receiver;
        if (++held == W) flush();
    }

    Scene scene;
    Query query;
    float end;
    uint32_t* seen;
    Ray<W> ray, waiting;
    alignas(64) int valid[W];
    uint32_t owner[W];
    int held = 0;
};

/// As Embree's manual advises for every thread that traces: no slow path for denormals.
void flush_denormals() {
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

/// Shares `count` items out to `threads` threads, `at_once` at a time. Each works with a `make()` of its
/// own, which `done` sees at the end. Gives back the seconds.
template <class Make, class Done>
double spread(uint32_t count, uint32_t at_once, unsigned threads, Make make, Done done) {
    auto start = std::chrono::steady_clock::now();
    std::atomic<uint64_t> next{0};
    using Worker = decltype(make());
    std::vector<Worker> workers;
    for (unsigned i = 0; i < threads; i++) workers.push_back(make());
    auto run = [&](Worker& worker) {
        flush_denormals();
        for (;;) {
            uint64_t first = next.fetch_add(at_once, std::memory_order_relaxed);
            if (first >= count) return;
            worker(static_cast<uint32_t>(first), static_cast<uint32_t>(std::min<uint64_t>(first + at_once, count)));
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads; i++) others.emplace_back([&, i] { run(workers[i]); });
    run(workers[0]);
    for (auto& thread : others) thread.join();
    double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (auto& worker : workers) done(worker);
    return seconds;
}

// Of workers side by side: their counters must not share a line that the threads then fight over.
constexpr size_t APART = 128;

template <int W>
struct alignas(APART) ShadowWorker {
    const Case& it;
    const SampleSet& set;
    Tester<W> tester;

    void operator()(uint32_t first, uint32_t end) {
        Block block;
        for (uint32_t r = first; r < end; r++) {
            Aim aim(it.light, it.receivers[r], r);
            if (aim.all_below()) continue;
            for (uint32_t at = 0; at < set.count; at += BLOCK) {
                aim.block(set, at, block);
                tester.block(block, aim.origin(), r);
            }
        }
        tester.flush();
    }
};

template <int W>
struct alignas(APART) CameraWorker {
    const Case& it;
    Scene scene;
    Query query;
    uint32_t* ids;
    uint64_t hits = 0;

    void operator()(uint32_t first, uint32_t end) {
        RayHit<W> packet;
        blank(packet.ray);
        std::memset(&packet.hit, 0xff, sizeof packet.hit);
        std::fill(packet.ray.org_x, packet.ray.org_x + W, it.eye.x);
        std::fill(packet.ray.org_y, packet.ray.org_y + W, it.eye.y);
        std::fill(packet.ray.org_z, packet.ray.org_z + W, it.eye.z);
        alignas(64) int valid[W];
        for (uint32_t at = first; at < end; at += W) {
            int some = static_cast<int>(std::min<uint32_t>(W, end - at));
            for (int i = 0; i < W; i++) {
                valid[i] = i < some ? -1 : 0;
                Vec3 d = it.camera[at + static_cast<uint32_t>(std::min(i, some - 1))];
                packet.ray.dir_x[i] = d.x;
                packet.ray.dir_y[i] = d.y;
                packet.ray.dir_z[i] = d.z;
                packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
                packet.hit.geometry[i] = NO_ID;
            }
            intersect(valid, scene, &packet, &query);
            for (int i = 0; i < some; i++) {
                bool hit = packet.hit.geometry[i] != NO_ID;
                ids[at + static_cast<uint32_t>(i)] = hit ? packet.hit.triangle[i] : NO_ID;
                hits += hit;
            }
        }
    }
};

struct Options {
    const char* path = nullptr;
    unsigned threads = 2;
    int scene_flags = SCENE_NONE;
    int quality = QUALITY_HIGH;
    std::string config;
};

Options read_options(int count, char** words) {
    Options it;
    for (int i = 1; i < count; i++) {
        std::string word = words[i];
        auto value = [&] {
            if (++i >= count) fail(word + " needs a value");
            return std::string(words[i]);
        };
        if (word == "--threads") it.threads = static_cast<unsigned>(std::max(1, std::atoi(value().c_str())));
        else if (word == "--robust") it.scene_flags |= SCENE_ROBUST;
        else if (word == "--compact") it.scene_flags |= SCENE_COMPACT;
        else if (word == "--config") it.config = value();
        else if (word == "--quality") {
            std::string name = value();
            if (name == "low") it.quality = QUALITY_LOW;
            else if (name == "medium") it.quality = QUALITY_MEDIUM;
            else if (name == "high") it.quality = QUALITY_HIGH;
            else fail("do not know the quality " + name);
        } else if (word[0] == '-' || it.path) fail("do not know " + word);
        else it.path = words[i];
    }
    if (!it.path) fail("usage: embree_side CASE.bin [--threads N] [--robust] [--compact] [--quality low|medium|high] [--config TEXT]");
    return it;
}

class Bench {
public:
    Bench(const Options& options, Case read)
        : options(options), it(std::move(read)), set(it.samples) {
        std::string config = "threads=" + std::to_string(options.threads);
        if (!options.config.empty()) config += "," + options.config;
        device = rtcNewDevice(config.c_str());
        if (!device) fail("Embree gives no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
        if (rtcGetDeviceProperty(device, PROPERTY_MAJOR) != 4) fail("the declarations are those of Embree 4");
        build();
    }

    ~Bench() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    template <int W>
    void shadow(int flags) {
        std::vector<uint32_t> counts(it.receivers.size());
        float end = it.light.kind == Kind::Sun ? std::numeric_limits<float>::infinity() : LIGHT_END;
        Query query{flags};
        uint64_t rays = 0;
        double seconds = spread(
            static_cast<uint32_t>(counts.size()), RECEIVERS_AT_ONCE, options.threads,
            [&] { return ShadowWorker<W>{it, set, Tester<W>(scene, query, end, counts.data())}; },
            [&](const ShadowWorker<W>& worker) { rays += worker.tester.rays; });
        double sum = 0;
        visible.resize(counts.size());
        for (size_t i = 0; i < counts.size(); i++) {
            visible[i] = static_cast<float>(counts[i]) / static_cast<float>(it.samples);
            sum += counts[i];
        }
        double mean = counts.empty() ? 0 : sum / it.samples / static_cast<double>(counts.size());
        std::printf("{\"seconds\":%.9g,\"rays\":%" PRIu64 ",\"mean\":%.9g}\n", seconds, rays, mean);
    }

    template <int W>
    void camera(int flags) {
        ids.resize(it.camera.size());
        Query query{flags};
        uint64_t hits = 0;
        double seconds = spread(
            static_cast<uint32_t>(ids.size()), CAMERA_RAYS_AT_ONCE, options.threads,
            [&] { return CameraWorker<W>{it, scene, query, ids.data()}; },
            [&](const CameraWorker<W>& worker) { hits += worker.hits; });
        std::printf("{\"seconds\":%.9g,\"hits\":%" PRIu64 "}\n", seconds, hits);
    }

    /// Whether given rays hit anything, W at a time, a byte for each; not timed. A ray is an origin, a
    /// direction and 1 if it ends short of their sum, or 0.
    template <int W>
    void rays(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        uint32_t head[2] = {1, 0};
        file.read(reinterpret_cast<char*>(head), sizeof head);
        std::vector<float> numbers(7 * static_cast<size_t>(head[1]));
        file.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(float)));
        if (!file || head[0] != 0) {
            std::printf("{\"error\":\"cannot read the rays\"}\n");
            return;
        }
        hit.resize(head[1]);
        Query query{QUERY_INCOHERENT};
        spread(head[1], RECEIVERS_AT_ONCE, options.threads, [&] {
            return [&](uint32_t first, uint32_t end) {
                Ray<W> packet;
                blank(packet);
                alignas(64) int valid[W];
                for (uint32_t at = first; at < end; at += W) {
                    uint32_t some = std::min<uint32_t>(W, end - at);
                    for (uint32_t i = 0; i < W; i++) {
                        const float* ray = &numbers[7 * static_cast<size_t>(at + std::min(i, some - 1))];
                        valid[i] = i < some ? -1 : 0;
                        packet.org_x[i] = ray[0];
                        packet.org_y[i] = ray[1];
                        packet.org_z[i] = ray[2];
                        packet.dir_x[i] = ray[3];
                        packet.dir_y[i] = ray[4];
                        packet.dir_z[i] = ray[5];
                        packet.tfar[i] = ray[6] != 0 ? LIGHT_END : std::numeric_limits<float>::infinity();
                    }
                    occluded(valid, scene, &packet, &query);
                    for (uint32_t i = 0; i < some; i++) hit[at + i] = packet.tfar[i] < 0;
                }
            };
        }, [](const auto&) {});
        write(path + ".embree", hit);
    }

    void dump(const std::string& path) const { write(path, visible); }
    void dump_hits(const std::string& path) const { write(path, ids); }

private:
    template <class T>
    static void write(const std::string& path, const std::vector<T>& what) {
        if (what.empty()) {
            std::printf("{\"error\":\"nothing to write yet\"}\n");
            return;
        }
        std::ofstream file(path, std::ios::binary);
        file.write(reinterpret_cast<const char*>(what.data()), static_cast<std::streamsize>(what.size() * sizeof(T)));
        file.close();
        if (file) std::printf("{\"written\":%zu}\n", what.size());
        else std::printf("{\"error\":\"cannot write the file\"}\n");
    }

    void build() {
        corner_ids.resize(3 * static_cast<size_t>(it.triangles));
        for (size_t i = 0; i < corner_ids.size(); i++) corner_ids[i] = static_cast<uint32_t>(i);
        auto start = std::chrono::steady_clock::now();
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, options.scene_flags);
        rtcSetSceneBuildQuality(scene, options.quality);
        Geometry mesh = rtcNewGeometry(device, GEOMETRY_TRIANGLE);
        rtcSetGeometryBuildQuality(mesh, options.quality);
        rtcSetSharedGeometryBuffer(mesh, BUFFER_VERTEX, 0, FORMAT_FLOAT3, it.corners.data(), 0, 12, corner_ids.size());
        rtcSetSharedGeometryBuffer(mesh, BUFFER_INDEX, 0, FORMAT_UINT3, corner_ids.data(), 0, 12, it.triangles);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene);
        double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (int error = rtcGetDeviceError(device)) fail("Embree's error " + std::to_string(error) + " while building");
        auto property = [&](int which) { return static_cast<int>(rtcGetDeviceProperty(device, which)); };
        std::printf("{\"build_seconds\":%.9g,\"embree\":\"%d.%d.%d\",\"native16\":%s,\"threads\":%u,\"triangles\":%u,\"receivers\":%zu,\"samples\":%u,\"camera_rays\":%zu}\n",
                    seconds, property(PROPERTY_MAJOR), property(PROPERTY_MINOR), property(PROPERTY_PATCH),
                    property(PROPERTY_NATIVE_16) ? "true" : "false", options.threads, it.triangles,
                    it.receivers.size(), it.samples, it.camera.size());
        std::fflush(stdout);
    }

    Options options;
    Case it;
    SampleSet set;
    // Embree reads these two where they lie.
    std::vector<uint32_t> corner_ids;
    Device device = nullptr;
    Scene scene = nullptr;
    std::vector<float> visible;
    std::vector<uint32_t> ids;
    std::vector<uint8_t> hit;
};

} // namespace

int main(int count, char** words) {
    flush_denormals();
    Options options = read_options(count, words);
    Bench bench(options, read_case(options.path));
    std::string line;
    while (std::getline(std::cin, line)) {
        size_t space = line.find(' ');
        std::string command = line.substr(0, space), rest = space == std::string::npos ? "" : line.substr(space + 1);
        int flags = rest == "incoherent" ? QUERY_INCOHERENT : QUERY_COHERENT;
        if (command == "shadow") bench.shadow<16>(flags);
        else if (command == "shadow8") bench.shadow<8>(flags);
        else if (command == "shadow1") bench.shadow<1>(flags);
        else if (command == "camera") bench.camera<1>(flags);
        else if (command == "camera8") bench.camera<8>(flags);
        else if (command == "camera16") bench.camera<16>(flags);
        else if (command == "rays") bench.rays<1>(rest);
        else if (command == "rays16") bench.rays<16>(rest);
        else if (command == "dump") bench.dump(rest);
        else if (command == "dumphits") bench.dump_hits(rest);
        else if (command == "quit") break;
        else std::printf("{\"error\":\"unknown command\"}\n");
        std::fflush(stdout);
    }
    return 0;
}
