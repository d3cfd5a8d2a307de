// What a shadow technique is asked: what all of them share, and what each understands besides.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/depth_packing.h"
#include "ninebit/shadow/index_codes.h"

namespace NINEBIT_PUBLIC ninebit {

// index-cube, and the index shadows of light-cookie.
struct IndexSettings {
  IndexFormat format = IndexFormat::rgb;
  IndexScope scope = IndexScope::polygon;
  int step = 2;  // 1 to kMaxIndexStep
  // Triangles a section at most, with IndexScope::section: kMinSectionSize to kMaxSectionSize, taken down to a multiple
  // of four.
  int section_size = 64;
};

enum class DepthCubeBits : std::uint8_t {
  eight,    // a luminance cube map and a luminance ramp, subtracted
  sixteen,  // luminance-alpha: high and low byte, compared by NVIDIA's mux in two stencil passes
  real      // floats, beyond the hardware: the yardstick
};

struct DepthCubeSettings {
  DepthCubeBits bits = DepthCubeBits::eight;
  std::optional<float> bias{};  // world units by which a surface may lie behind the map's; empty: the technique's own
};

// glPolygonOffset's arguments.
struct OffsetArguments {
  float factor = 0.0F;
  float units = 0.0F;
};

struct ShadowMapSettings {
  std::optional<OffsetArguments> polygon_offset{};  // while the map is drawn; empty: the technique's own
  DepthEncoding encoding = DepthEncoding::d24;
  ChannelStorage storage = ChannelStorage::round;  // of the rgba8 encodings
};

enum class VolumeMethod : std::uint8_t { depth_fail, depth_pass };

struct ShadowVolumeSettings {
  VolumeMethod method = VolumeMethod::depth_fail;
  bool two_sided = true;  // both faces of a volume in one pass; otherwise one after the other
};

enum class SamplePattern : std::uint8_t {
  poisson,  // a rotated Poisson disk, each sample weighted by the square of its offset
  polar     // the paper's: radius and angle uniform, each sample weighted by its radius squared
};

struct ReflectiveSettings {
  int samples = 400;       // pixel lights a pixel: 1 to kMaxPixelLights
  float kernel = 143.36F;  // radius of the pattern in texels: 1 to kMaxSurfaceSize
  SamplePattern pattern = SamplePattern::poisson;
  int gather_scale = 1;  // pixels a side of one low-resolution sample: 1 (every pixel by itself) to 16
};
inline constexpr int kMaxPixelLights = 4096;

struct LightCookieSettings {
  std::shared_ptr<const Texture> cookie{};  // a cube map; required by light-cookie
  glm::vec3 rotate_degrees{0.0F};           // of the light: about x, then y, then z, in world space
  bool shadows = true;                      // with index shadows
};

struct RenderSettings {
  int width = 1024;  // pixels, 1 to kMaxSurfaceSize
  int height = 768;
  int map_size = 512;         // texels a side of the light's map or cube-map face: a power of two, 1 to kMaxSurfaceSize
  bool light_facing = false;  // polygons that face away from the light are shadowed (the article leaves them lit)
  bool cartoon = false;       // flat shading, the stencil's shadow in ink
  CullFace cull_face = CullFace::none;                           // in every pass, from the light as from the camera
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // of the frame
  bool layers = false;                                           // keep every intermediate value of the camera's view
  bool evidence = false;                                         // keep what ground_truth.h judges by
  std::optional<glm::ivec2> pixel;                               // to be watched: window coordinates of the frame, y up
  std::optional<glm::ivec2> pick;                                // whose index is to be read: likewise
  HardwareProfile profile = profiles::geforce2;

  IndexSettings index{};
  DepthCubeSettings depth_cube{};
  ShadowMapSettings shadow_map{};
  ShadowVolumeSettings shadow_volume{};
  ReflectiveSettings reflective{};
  LightCookieSettings light_cookie{};
};

}  // namespace ninebit
