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
  IndexFormat format = IndexFormat::rgb;   // of the map and of the polygons' colours
  IndexScope scope = IndexScope::polygon;  // what is told apart
  int step = 2;                            // 1 to kMaxIndexStep
  // Triangles a section at most, with IndexScope::section: kMinSectionSize to kMaxSectionSize, taken down to a multiple
  // of four.
  int section_size = 64;
};

// What a distance to the light is held in.
enum class DepthCubeBits : std::uint8_t {
  eight,    // a luminance cube map and a luminance ramp, subtracted
  sixteen,  // luminance-alpha: high and low byte, compared by NVIDIA's mux in two stencil passes
  real      // floats, beyond the hardware: the yardstick
};

// depth-cube.
struct DepthCubeSettings {
  DepthCubeBits bits = DepthCubeBits::eight;  // of the map
  std::optional<float> bias{};  // world units by which a surface may lie behind the map's; empty: the technique's own
};

// glPolygonOffset's arguments.
struct OffsetArguments {
  float factor = 0.0F;  // of the polygon's slope
  float units = 0.0F;   // of the depth format's steps
};

// shadow-map, and the direct light of reflective.
struct ShadowMapSettings {
  std::optional<OffsetArguments> polygon_offset{};  // while the map is drawn; empty: the technique's own
  DepthEncoding encoding = DepthEncoding::d24;      // of the map
  ChannelStorage storage = ChannelStorage::round;   // of the rgba8 encodings
};

// Whether volumes are counted where they lie behind what the camera sees, or in front of it.
enum class VolumeMethod : std::uint8_t { depth_fail, depth_pass };

// shadow-volume.
struct ShadowVolumeSettings {
  VolumeMethod method = VolumeMethod::depth_fail;  // depth_pass fails where the camera is in a shadow
  bool two_sided = true;                           // both faces of a volume in one pass; otherwise one after the other
};

// Which texels of the light's view are gathered for a pixel.
enum class SamplePattern : std::uint8_t {
  poisson,  // a rotated Poisson disk, each sample weighted by the square of its offset
  polar     // the paper's: radius and angle uniform, each sample weighted by its radius squared
};

// reflective.
struct ReflectiveSettings {
  int samples = 400;                               // pixel lights a pixel: 1 to kMaxPixelLights
  float kernel = 143.36F;                          // radius of the pattern in texels: 1 to kMaxSurfaceSize
  SamplePattern pattern = SamplePattern::poisson;  // of the pixel lights
  int gather_scale = 1;  // pixels a side of one low-resolution sample: 1 (every pixel by itself) to 16
};
// The most pixel lights a pixel.
inline constexpr int kMaxPixelLights = 4096;

// light-cookie.
struct LightCookieSettings {
  std::shared_ptr<const Texture> cookie{};  // a cube map; required by light-cookie
  glm::vec3 rotate_degrees{0.0F};           // of the light: about x, then y, then z, in world space
  bool shadows = true;                      // with index shadows
};

// What is asked of a technique. Each reports values outside of the ranges that stand here.
struct RenderSettings {
  int width = 1024;           // pixels, 1 to kMaxSurfaceSize
  int height = 768;           // pixels, likewise
  int map_size = 512;         // texels a side of the light's map or cube-map face: a power of two, 1 to kMaxSurfaceSize
  bool light_facing = false;  // polygons that face away from the light are shadowed (the article leaves them lit)
  bool cartoon = false;       // flat shading, the stencil's shadow in ink
  CullFace cull_face = CullFace::none;                           // in every pass, from the light as from the camera
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // of the frame
  bool layers = false;                                           // keep every intermediate value of the camera's view
  bool evidence = false;                                         // keep what ground_truth.h judges by
  std::optional<glm::ivec2> pixel;                               // to be watched: window coordinates of the frame, y up
  std::optional<glm::ivec2> pick;                                // whose index is to be read: likewise
  HardwareProfile profile = profiles::geforce2;                  // of combiners and rasterizer

  IndexSettings index{};                 // read by the techniques that it names
  DepthCubeSettings depth_cube{};        // likewise
  ShadowMapSettings shadow_map{};        // likewise
  ShadowVolumeSettings shadow_volume{};  // likewise
  ReflectiveSettings reflective{};       // likewise
  LightCookieSettings light_cookie{};    // likewise
};

}  // namespace ninebit
