// An effect: passes of register-combiner programs over textures and a mesh, as plain data. It is the rasterizer's state
// in words. effect_json.h reads effects from JSON, effect_renderer.h draws them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/frame/index_codes.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene_io.h"

namespace NINEBIT_PUBLIC ninebit {

// The number of texture units that an effect can use.
inline constexpr std::size_t kEffectUnits = 4;
// The name of the target that every effect has: the picture.
inline constexpr std::string_view kPictureTarget = "picture";
// The most passes of an effect.
inline constexpr std::size_t kMaxEffectPasses = 256;

// The vector that a vertex gives to a texture unit or a colour. All vectors are in world space, except the
// tangent-space ones, whose x, y and z lie along the tangent, the bitangent and the normal. N, P, L and E are the
// vertex normal, the position, the light and the camera.
enum class VertexSource : std::uint8_t {
  constant,              // the given numbers
  uv,                    // the mesh's texture coordinates; (0, 0) is the top left corner of a picture file
  screen,                // the place in the target: (0, 0) is its lower left corner, (1, 1) its upper right one
  projected,             // the place in the light's view, likewise, and its depth, divided by q
  position,              // P
  from_light,            // P - L, or the direction of a directional light
  light_vector,          // L - P: towards the light, not normalized
  view_vector,           // E - P: towards the camera, not normalized
  half_vector,           // normalized L - P plus normalized E - P, normalized
  normal,                // N
  reflection,            // the view vector reflected at the normal, normalized: it leaves the surface
  tangent_light_vector,  // light_vector in tangent space, not normalized
  tangent_half_vector,   // half_vector in tangent space
  tangent_to_world_x,    // the x of tangent, bitangent and N, and of the view vector as q: a row of the matrix that
                         // turns a normal of tangent space into world space, with the eye, for reflections by stages
  tangent_to_world_y,    // likewise
  tangent_to_world_z,    // likewise
  point_sprite,          // the place in a point, (0, 0) at its upper left corner: of polygon mode point
  color,                 // the mesh's vertex colour times its material's base colour
  secondary_color,       // the mesh's secondary vertex colour
  lambert,               // the base colour times the light's colour times max(0, dot(N, L)); alpha of `color`
  index                  // the colour of the polygon's index: flat, as in index cube shadow mapping
};

// The texture coordinates of a unit: `source`, then `matrix`, as GL's texture matrix multiplies (s, t, r, q).
struct CoordinateSource {
  VertexSource source = VertexSource::uv;      // uv to point_sprite, or constant
  glm::vec4 constant{0.0F, 0.0F, 0.0F, 1.0F};  // of VertexSource::constant: s, t, r, q
  glm::mat4 matrix{1.0F};                      // glm's columns
  friend bool operator==(const CoordinateSource&, const CoordinateSource&) = default;
};

// A vertex colour. Vectors are normalized and range-compressed: a component v becomes (v + 1) / 2, alpha is 1.
struct ColorSource {
  VertexSource source = VertexSource::constant;  // position to tangent_half_vector, color to index, or constant
  glm::vec4 constant{1.0F};                      // red, green, blue, alpha in [0, 1]
  IndexFormat index_format = IndexFormat::rgb;   // of `index`
  int index_step = 2;                            // of `index`: 1 to kMaxIndexStep
  friend bool operator==(const ColorSource&, const ColorSource&) = default;
};

// The fog factor of a vertex from the distance z to the camera's plane, as GL_FOG_MODE computes it.
enum class FogMode : std::uint8_t {
  none,      // GL_FOG is disabled
  mesh,      // the factors of the mesh's vertices
  linear,    // (end - z) / (end - start)
  exp,       // e^(-density z)
  exp2,      // e^(-(density z)^2)
  registers  // z itself, from which the chip's function computes the factor of each fragment (rule 49)
};

// Fog of a pass. Factors are clamped to [0, 1]; 1 is no fog.
struct EffectFog {
  FogMode mode = FogMode::none;                // how the factor is computed
  float start = 0.0F;                          // of linear, in world units
  float end = 1.0F;                            // of linear, in world units, different from start
  float density = 1.0F;                        // of exp and exp2, per world unit, not negative
  FogFunction function = FogFunction::linear;  // of registers
  float bias = 0.0F;                           // of registers
  float slope = 0.0F;                          // of registers, per world unit
  std::array<std::uint8_t, 3> color{};         // the fog register's red, green, blue
  friend bool operator==(const EffectFog&, const EffectFog&) = default;
};

// Where a texture comes from.
enum class TextureOrigin : std::uint8_t {
  file,             // one 2D picture or DDS file
  cube_files,       // six pictures, in the order of CubeFace
  normalize_cube,   // normalization_cube_map(size)
  checker,          // checkerboard(size)
  gradient,         // gradient()
  falloff,          // attenuation()
  normals,          // normal_map() of a file
  signed_normals,   // signed_normal_map() of a file
  hilo_normals,     // hilo_normal_map() of a file
  hilo_heights,     // hilo_height_map() of a file
  offsets,          // offset_map() of a file
  one_dimensional,  // the first row of a file as a 1D texture
  volume,           // a file's squares, one below the other, as the layers of a 3D texture
  rectangle,        // a file as a rectangle texture
  target_color,     // the colour planes of a target
  target_depth      // the depth plane of a target
};

// A texture of an effect.
struct EffectTexture {
  std::string name{};                          // in the effect
  TextureOrigin origin = TextureOrigin::file;  // which of the following members are used
  std::vector<std::string> files{};            // relative to the effect's folder
  std::string target{};                        // the name of a target
  int size = 0;                                // texels a side
  float steepness = 4.0F;                      // of normals and offsets: see normal_map()
  Sampler sampler{};                           // how units read it
};

// A render target besides the picture.
struct EffectTarget {
  std::string name{};                                            // in the effect
  bool cube = false;                                             // six faces around the light
  int width = 0;                                                 // pixels; of a cube, texels a side
  int height = 0;                                                // pixels; of a cube the same as the width
  InternalFormat format = InternalFormat::rgba8;                 // as a texture: one of the 8-bit formats
  ColorFormat color_format = ColorFormat::a8r8g8b8;              // of its colour planes
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // of its depth and stencil planes
  SampleMode samples = SampleMode::center_1;  // of each pixel; as a texture, every sample is a texel (rule 48)
  friend bool operator==(const EffectTarget&, const EffectTarget&) = default;
};

// The texture that a pass reads through one unit, and how.
struct EffectUnit {
  std::string texture{};           // the name of a texture of the effect; empty: the unit has none
  CoordinateSource coordinates{};  // where it is read, or what a texture-shader stage without a texture reads
};

// Which planes a pass clears before it draws, and to what.
struct EffectClear {
  bool color = false;    // clears the colour planes
  bool depth = false;    // clears the depth plane
  bool stencil = false;  // clears the stencil plane
  ClearValues values{};  // the values
};

// The geometry that a pass draws.
enum class EffectGeometry : std::uint8_t {
  mesh,      // the scene's triangles
  rectangle  // two triangles that fill the target: uv (0, 0) is the upper left corner, the normal +z, the tangent +x
};

// From where a pass sees the mesh. A cube target is always seen from the light, a face at a time.
enum class EffectView : std::uint8_t { camera, light };

// The constant colours of a pass, which replace those of its program. A general combiner's own constant enables
// GL_PER_STAGE_CONSTANTS_NV; combiners without one keep the global constant.
struct EffectConstants {
  using Pair = std::array<std::optional<ColorF>, 2>;     // constant colour 0 and 1
  Pair global{};                                         // of all combiners
  std::array<Pair, kMaxGeneralCombiners> of_combiner{};  // of one general combiner, from 0
};

// One draw call.
struct EffectPass {
  std::string name{};                              // for messages, traces and layers
  EffectGeometry geometry = EffectGeometry::mesh;  // what is drawn
  EffectView view = EffectView::camera;            // of a mesh, for a target that is not a cube
  std::string target{kPictureTarget};              // the name of a target
  std::string program{};                           // a file, relative to the effect's folder; empty: the combiners
                                                   // are off and the primary colour is drawn
  EffectConstants constants{};                     // of the program
  std::array<EffectUnit, kEffectUnits> units{};    // the texture units
  ColorSource primary{};                           // the primary colour
  ColorSource secondary{.constant = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)};  // the secondary colour
  EffectFog fog{};                                                       // the fog registers
  EffectClear clear{};                                                   // before the draw
  // Fragment state; its profile, program, viewport, fog and point sprites are set when the effect is drawn, and so are
  // texture-shader stages of the program's file unless it has its own.
  PipelineState state{};
};

// The scene of an effect: the mesh, and the camera and light that vectors refer to. Without a mesh, rectangles lie in
// the plane z = 0 from (-1, -1) to (1, 1); the camera is at (0, 0, 3) and the light at (-1, 1, 1), unless the setup
// says otherwise, and a directional light shines at the setup's target or the origin.
struct EffectScene {
  std::string mesh{};                      // a scene file, relative to the effect's folder, or a generated mesh
                                           // (generated_meshes.h); empty: only rectangles are drawn
  std::optional<UpAxis> up{};              // of the scene file, instead of what it says
  SceneSetup setup{};                      // camera, light and floor
  std::optional<glm::vec3> light_color{};  // replaces the light's colour, each channel in [0, 1]
  friend bool operator==(const EffectScene&, const EffectScene&) = default;
};

// An effect.
struct Effect {
  std::string title{};                               // a line for people; may be empty
  std::string note{};                                // what it shows; may be empty
  std::string profile{};                             // the name of a built-in profile; empty: the caller's
  bool moves = false;                                // whether a number of its file depends on the time or frame
  std::string folder{};                              // where relative file names begin; empty: the current folder
  int width = 512;                                   // of the picture, pixels, 1 to kMaxSurfaceSize
  int height = 512;                                  // likewise
  ColorFormat color_format = ColorFormat::a8r8g8b8;  // of the picture
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // of the picture
  EffectScene scene{};                                           // the mesh
  std::vector<EffectTexture> textures{};                         // by name
  std::vector<EffectTarget> targets{};                           // besides the picture
  std::vector<EffectPass> passes{};                              // in the order of drawing, 1 to kMaxEffectPasses
};

// The part of an effect that a fault is about.
enum class EffectPart : std::uint8_t { whole, texture, target, pass };

// A fault of an effect.
struct EffectFault {
  EffectPart part = EffectPart::whole;  // where it is
  std::size_t number = 0;               // the texture's, target's or pass's, from 0
  std::string message{};                // one sentence, with the part's name
};

// Checks an effect by itself, without its files: names that are defined once and known; sizes in range; sources that
// suit their use; a target that is read in the pass that draws it, or before any pass draws it; a rectangle or a colour
// of indices where there can be none; a mesh without a scene. Returns all faults, in the order of the effect.
[[nodiscard]] std::vector<EffectFault> check_effect(const Effect& effect);

// "uv", "light-vector", …, as in JSON and on the command line.
[[nodiscard]] std::string_view name_of(VertexSource source);

// Reads "uv", "normal", "constant:X,Y[,Z[,W]]" and the like. The message of a fault says what was expected.
[[nodiscard]] Result<CoordinateSource> parse_coordinate_source(std::string_view text);
// Reads "color", "lambert", "light-vector", "index[:FORMAT,STEP]", "constant:R,G,B[,A]" and the like.
[[nodiscard]] Result<ColorSource> parse_color_source(std::string_view text);
// Reads "none", "linear:START,END", "exp:DENSITY" and "exp2:DENSITY"; the colour stays black.
[[nodiscard]] Result<EffectFog> parse_fog(std::string_view text);
// Reads a file name, six file names with commas between them, "normalize-cube:N", "checker:N", "gradient", "falloff",
// "normals:FILE", "signed-normals:FILE", "hilo-normals:FILE", "hilo-heights:FILE", "offsets:FILE", "1d:FILE",
// "3d:FILE", "rectangle:FILE", "target:NAME" and "depth:NAME" into a texture without a name. Its sampler suits the
// origin: trilinear and repeat for files, normals, offsets, 1D textures and checker; linear and repeat for HILO and 3D
// textures; linear and clamp-to-edge for rectangles and other generated ones; nearest and clamp-to-edge
// for targets. Components of signed normals and HILO normals are signed.
[[nodiscard]] Result<EffectTexture> parse_texture_source(std::string_view text);
// Reads "nearest", "linear", "bilinear-mipmap" (GL_LINEAR_MIPMAP_NEAREST) and "trilinear" into the sampler's filters.
[[nodiscard]] Status parse_filter(std::string_view text, Sampler& sampler);
// Reads "repeat", "clamp", "clamp-to-edge", "mirrored-repeat" and "clamp-to-border" into the sampler's wraps.
[[nodiscard]] Status parse_wrap(std::string_view text, Sampler& sampler);
// Reads "R,G,B,A", numbers from 0 to 1, into the border colour.
[[nodiscard]] Status parse_border_color(std::string_view text, Sampler& sampler);
// Reads "s", "t" and "st" into the directions that wrap around a cylinder.
[[nodiscard]] Status parse_cylinder_wrap(std::string_view text, Sampler& sampler);
// Reads "OPERATION:AARRGGBB", the operation of a colour key, "alpha", "rgba" or "kill", and its word in hexadecimal.
[[nodiscard]] Status parse_color_key(std::string_view text, Sampler& sampler);
// Reads rows of 0 and 1 with commas between them, as they are seen, such as "10,01": 1, 2, 4, 8, 16 or 32 rows of
// 1, 2, 4, 8, 16 or 32 digits each. The pattern is repeated to 32 x 32 pixels from the lower left corner; 1 is drawn.
[[nodiscard]] Result<StipplePattern> parse_polygon_stipple(std::string_view text);

}  // namespace ninebit
