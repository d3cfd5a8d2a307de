// Reading scenes from files, and completing scenes without a camera, light or floor.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"

namespace NINEBIT_PUBLIC ninebit {

// How a scene is read.
struct SceneReadOptions {
  bool allow_outside = false;  // files that the scene names may be anywhere; otherwise only below its own folder
  // The axis that points up in the file, instead of what the file or its format says.
  std::optional<UpAxis> up{};
  // Foreign code (Assimp for 3DS, Draco for compressed glTF meshes) runs in a child process that opens no file and has
  // 1 GiB of memory and 64 times the file, 8 s of processor time and 1 s for each 1,000,000 bytes; for Draco, 256 bytes
  // and 1 µs more for each triangle that the file declares. A file that crashes the child or exceeds these limits is
  // reported like any other fault; without `isolated` it may end this process. STL, COLLADA, FBX and glTF 1.0 are
  // always read by such a child. The child is a fork of this one: no
  // other thread may be inside Assimp meanwhile.
  bool isolated = false;
  // The most triangles of a glTF file with all its nodes: at most 2^27.
  std::uint64_t most_triangles = std::uint64_t{1} << 27U;
  std::function<bool()> go_on{};  // called while a child reads; false ends it with Fault::cancelled; may be empty
};

// Reads glTF 2.0 (.gltf, .glb: node hierarchy, materials' base colours, cameras, KHR_lights_punctual,
// KHR_draco_mesh_compression), glTF 1.0, OBJ, PLY, OFF, 3DS, STL, COLLADA (.dae) and FBX. All nodes are flattened into
// world space. Degenerate triangles are kept: they count as polygons and cover no pixel. Reports, naming the file:
// missing, empty, truncated or malformed files, no triangles, positions that are NaN or infinite, indices out of range,
// files beyond docs/internals/limits.md (2^27 triangles and more).
//
// The triangles keep the file's count and order; polygons are cut into n - 2 triangles. Corners of one object with
// equal position and normal share a vertex; where the file gives no normal it is the area-weighted mean of the object's
// triangles at that position. Spot lights of 3DS files, orthographic cameras, skins, morph targets and animations are
// left out; Scene::notes lists what a glTF or OBJ file has beyond that. Pictures are named and not read
// (SceneTexture). Sparse glTF accessors are rejected. An OBJ file declares no counts, so one that is truncated
// exactly between two faces cannot be detected.
//
// Files that a scene names (glTF buffers, OBJ material libraries) are regular files below the scene's folder; a name
// that leads elsewhere is rejected; that of a picture becomes SceneTexture::fault. A missing material library is noted
// in the scene. Libraries are read only if a face has a material.
[[nodiscard]] Result<Scene> read_scene(const std::filesystem::path& file, const SceneReadOptions& options = {});

// Whether a floor is put under the scene.
enum class FloorChoice {
  automatic,  // a floor below a scene that has neither a camera nor a light; none otherwise
  none,
  at_height
};

// A set of light kinds.
struct LightKinds {
  bool point = true;                                        // shines everywhere
  bool spot = false;                                        // shines into a square pyramid
  bool directional = false;                                 // shines in one direction
  [[nodiscard]] constexpr bool has(LightKind kind) const {  // whether it is in the set
    return kind == LightKind::point ? point : kind == LightKind::spot ? spot : directional;
  }
  friend bool operator==(const LightKinds&, const LightKinds&) = default;
};

// The user's overrides; everything else comes from the file or from a default framing.
struct SceneSetup {
  std::optional<glm::vec3> camera{};           // world space
  std::optional<glm::vec3> look_at{};          // world space
  std::optional<float> fov_degrees{};          // vertical, from 0.01 to 170
  std::optional<glm::vec3> light{};            // world space
  LightKinds light_kinds{};                    // at least one
  std::optional<glm::vec3> light_target{};     // the point that a spot or directional light shines at
  std::optional<float> spot_degrees{};         // the opening angle of a spot light, from 1 to 170
  FloorChoice floor = FloorChoice::automatic;  // whether there is a floor
  float floor_height = 0.0F;                   // world y, for FloorChoice::at_height
  friend bool operator==(const SceneSetup&, const SceneSetup&) = default;
};

// A scene that can be rendered: exactly one camera and one light, and the floor added as an object named "floor" if the
// setup has one or it is automatic. Without a camera in the file: a three-quarter view that frames all
// triangles. Without a light: one above and to the side of the camera, outside the box.
//
// The light is the file's first one of a kind in setup.light_kinds. If there is none and a point light is allowed, it
// is the default light. Otherwise the file's first point light, or else the default light, becomes a spot light at its
// position (a directional one if only that is allowed). A spot or directional light shines at the target; without one
// as in the file; otherwise at the middle of the bounding box. A spot that neither the file nor the setup aims or opens
// holds what the camera sees, up to 150 degrees. A directional light that the setup moves shines at its
// target or at that middle, too.
//
// Reports what validate() reports; a camera at the light, or at the point that it looks at; a field of view outside of
// 0.01 to 170 degrees; a scene, floor, camera, look-at point or light with a coordinate outside of -1e12 to 1e12, so
// that squares and triple products of values derived from them stay finite in floats; a light that is at its target, or
// a target for a point light; and a point or spot light inside a solid, which is an object with a winding number above
// 3/4 at the light (an open one, too, if it encloses that much of the view) but not at the camera: in a room that is
// wound the wrong way around, both are inside. A light on an object's surface is not inside. A scene less than 1e-12
// across counts as a single point, which is framed from some distance.
//
// The first one of several cameras or lights is used. The default light follows the file's or the default view, so that
// moving the camera does not move the shadows. A view that the user changed has y up; an up vector along the view axis
// is replaced by another axis.
[[nodiscard]] Result<Scene> complete_scene(Scene scene, const SceneSetup& setup, float aspect_ratio);

}  // namespace ninebit
