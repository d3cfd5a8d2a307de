// The settings of shadow techniques: those that all share, and those of each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ninebit/frame/depth_packing.h"
#include "ninebit/frame/index_codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene.h"

namespace NINEBIT_PUBLIC ninebit {

// IndexOrder::neighbour: the most by which the normals of a patch's polygons differ from that of its first polygon, and
// by which the surface bends inward between two patches that count as neighbours.
inline constexpr float kPatchDegrees = 20.0F;
inline constexpr float kMinPatchDegrees = 0.0F;
inline constexpr float kMaxPatchDegrees = 90.0F;

// index-cube, and the index shadows of light-cookie.
struct IndexSettings {
  IndexFormat format = IndexFormat::rgb;   // of the map and of the polygons' colours
  IndexScope scope = IndexScope::polygon;  // the units that get an index each
  int step = 2;                            // 1 to kMaxIndexStep
  // The most triangles per section, with IndexScope::section: kMinSectionSize to kMaxSectionSize, rounded down to a
  // multiple of four.
  int section_size = 64;
  IndexOrder order = IndexOrder::file;     // how the units get their indices
  float patch_degrees = kPatchDegrees;     // IndexOrder::neighbour: kMinPatchDegrees to kMaxPatchDegrees; see there
  IndexScales scales = IndexScales::both;  // of the comparison
};

// How a distance to the light is stored.
enum class DepthCubeBits : std::uint8_t {
  eight,    // a luminance cube map and a luminance ramp, subtracted
  sixteen,  // luminance-alpha: high and low byte, compared by NVIDIA's mux in two stencil passes
  real      // floats, beyond the hardware: the reference
};

// depth-cube.
struct DepthCubeSettings {
  DepthCubeBits bits = DepthCubeBits::eight;  // of the map
  std::optional<float> bias{};  // in world units: how far a surface may lie behind the map's; empty: the default
};

// glPolygonOffset's arguments.
struct OffsetArguments {
  float factor = 0.0F;  // multiplies the polygon's slope
  float units = 0.0F;   // in steps of the depth format
};

// shadow-map, and the direct light of reflective.
struct ShadowMapSettings {
  std::optional<OffsetArguments> polygon_offset{};  // while the map is drawn; empty: kShadowMapOffset
  DepthEncoding encoding = DepthEncoding::d24;      // of the map
  ChannelStorage storage = ChannelStorage::round;   // of the rgba8 encodings
};

// Whether volumes are counted behind the visible surface (depth_fail) or in front of it (depth_pass).
enum class VolumeMethod : std::uint8_t { depth_fail, depth_pass };

// shadow-volume.
struct ShadowVolumeSettings {
  VolumeMethod method = VolumeMethod::depth_fail;  // depth_pass fails if the camera is in a shadow
  bool two_sided = true;                           // both faces of a volume in one pass; otherwise one after the other
};

// The texels of the light's view that are gathered for a pixel.
enum class SamplePattern : std::uint8_t {
  poisson,  // a rotated Poisson disk, each sample weighted by the square of its offset
  polar     // the paper's: radius and angle uniform, each sample weighted by its radius squared
};

// reflective.
struct ReflectiveSettings {
  int samples = 400;                               // pixel lights per pixel: 1 to kMaxPixelLights
  float kernel = 143.36F;                          // radius of the pattern in texels: 1 to kMaxSurfaceSize
  SamplePattern pattern = SamplePattern::poisson;  // of the pixel lights
  int gather_scale = 1;  // pixels a side per low-resolution sample: 1 (every pixel is gathered) to 16
};
// The most pixel lights per pixel.
inline constexpr int kMaxPixelLights = 4096;
// The most pixels a side per low-resolution sample.
inline constexpr int kMaxGatherScale = 16;

// light-cookie.
struct LightCookieSettings {
  std::shared_ptr<const Texture> cookie{};  // a cube map; required by light-cookie
  glm::vec3 rotate_degrees{0.0F};           // of the light: about x, then y, then z, in world space
  bool shadows = true;                      // with index shadows
};

// The settings of a rendering. Every technique reports values outside the ranges given here.
struct RenderSettings {
  int width = 1024;           // pixels, 1 to kMaxSurfaceSize
  int height = 768;           // pixels, likewise
  int map_size = 512;         // texels a side of the light's map or cube-map face: a power of two, 1 to kMaxSurfaceSize
  bool light_facing = false;  // shadows polygons that face away from the light (the article leaves them lit)
  bool cartoon = false;       // flat shading, with shadows in ink
  CullFace cull_face = CullFace::none;                           // in every pass, from the light and from the camera
  ColorFormat color_format = ColorFormat::a8r8g8b8;              // of the frame
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // of the frame
  bool layers = false;                                           // keeps every intermediate value of the camera's view
  bool evidence = false;                                         // keeps ShadowEvidence, for ground_truth.h
  std::vector<glm::ivec2> pixels{};                              // to be probed: window coordinates of the frame, y up
  std::optional<glm::ivec2> pick{};                              // whose index is read: window coordinates, y up
  HardwareProfile profile = profiles::geforce2;                  // of the combiners and the rasterizer

  IndexSettings index{};                 // of the techniques named at the type
  DepthCubeSettings depth_cube{};        // likewise
  ShadowMapSettings shadow_map{};        // likewise
  ShadowVolumeSettings shadow_volume{};  // likewise
  ReflectiveSettings reflective{};       // likewise
  LightCookieSettings light_cookie{};    // likewise
};

}  // namespace ninebit
