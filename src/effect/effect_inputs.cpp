#include "src/effect/effect_inputs.h"

#include <array>
#include <utility>

#include "ninebit/effect/generated_meshes.h"
#include "ninebit/effect/generated_textures.h"
#include "ninebit/scene/scene_io.h"
#include "src/effect/effect_words.h"

namespace ninebit {
namespace {

std::filesystem::path path_in(const Effect& effect, const std::string& file) {
  const std::filesystem::path path(file);
  return path.is_absolute() || effect.folder.empty() ? path : std::filesystem::path(effect.folder) / path;
}

// Adapts the file's texture to its origin.
Result<Texture> made_from(const Texture& file, const TextureRecipe& recipe) {
  const auto steepness = static_cast<double>(recipe.steepness);
  switch (recipe.origin) {
    case TextureOrigin::normals:
      return normal_map(file, steepness);
    case TextureOrigin::signed_normals:
      return signed_normal_map(file, steepness);
    case TextureOrigin::hilo_normals:
      return hilo_normal_map(file, steepness);
    case TextureOrigin::hilo_heights:
      return hilo_height_map(file);
    case TextureOrigin::offsets:
      return offset_map(file, steepness);
    case TextureOrigin::one_dimensional:
      return retargeted(file, TextureTarget::texture_1d);
    case TextureOrigin::volume:
      return retargeted(file, TextureTarget::texture_3d);
    case TextureOrigin::rectangle:
      return retargeted(file, TextureTarget::rectangle);
    default:
      return file;
  }
}

Result<Texture> texture_of_files(const TextureRecipe& recipe, const HardwareProfile& profile,
                                 const EffectReaders& readers) {
  const std::vector<std::filesystem::path>& files = recipe.files;
  if (recipe.origin == TextureOrigin::rectangle && readers.rectangle) return readers.rectangle(files[0], profile);
  auto read = readers.texture(files, profile);
  if (!read) return read;
  auto made = made_from(*read, recipe);
  if (made) return made;
  Diagnostic fault = made.error();
  fault.file = files[0].string();
  return fault;
}

Result<Texture> texture_without_mipmaps(const TextureRecipe& recipe, const HardwareProfile& profile,
                                        const EffectReaders& readers) {
  switch (recipe.origin) {
    case TextureOrigin::normalize_cube:
      return normalization_cube_map(recipe.size);
    case TextureOrigin::checker:
      return checkerboard(recipe.size);
    case TextureOrigin::gradient:
      return gradient();
    case TextureOrigin::falloff:
      return attenuation();
    default:
      return texture_of_files(recipe, profile, readers);
  }
}

Result<Texture> made_texture(const TextureRecipe& recipe, const HardwareProfile& profile,
                             const EffectReaders& readers) {
  auto made = texture_without_mipmaps(recipe, profile, readers);
  if (made && recipe.mip_signs && made->faces[0].size() == 1) return with_mipmaps(*made, *recipe.mip_signs);
  return made;
}

TextureRecipe recipe_of(const Effect& effect, const EffectTexture& texture) {
  TextureRecipe recipe{.origin = texture.origin, .size = texture.size, .steepness = texture.steepness};
  for (const std::string& file : texture.files) recipe.files.push_back(path_in(effect, file));
  if (needs_mipmaps(texture.sampler)) recipe.mip_signs = texture.sampler.is_signed;
  return recipe;
}

// Sets the camera and light of a rectangle from the setup.
void light_rectangle(const EffectScene& effect, Scene& scene) {
  const SceneSetup& setup = effect.setup;
  Camera camera{.position = setup.camera.value_or(glm::vec3(0.0F, 0.0F, 3.0F)),
                .look_at = setup.look_at.value_or(glm::vec3(0.0F))};
  if (setup.fov_degrees) camera.vertical_fov_degrees = *setup.fov_degrees;
  scene.cameras.push_back(camera);
  Light light;
  light.position = setup.light.value_or(glm::vec3(-1.0F, 1.0F, 1.0F));
  const glm::vec3 towards = setup.light_target.value_or(glm::vec3(0.0F)) - light.position;
  if (glm::length(towards) > 0.0F) light.direction = glm::normalize(towards);
  light.kind = setup.light_kinds.point  ? LightKind::point
               : setup.light_kinds.spot ? LightKind::spot
                                        : LightKind::directional;
  if (setup.spot_degrees) light.spot_degrees = *setup.spot_degrees;
  scene.lights.push_back(light);
}

}  // namespace

Diagnostic fault_in(const std::string& part, const Diagnostic& fault) {
  Diagnostic named = fault;
  named.message = fault.file.empty() ? part + ": " + fault.message : fault.message + " (" + part + ")";
  return named;
}

Result<Scene> effect_mesh(const Effect& effect, const EffectReaders& readers) {
  const std::string& mesh = effect.scene.mesh;
  if (mesh.empty()) return generated_mesh("plane:1");
  return is_generated_mesh(mesh) ? generated_mesh(mesh) : readers.scene(path_in(effect, mesh), effect.scene.up);
}

Result<Scene> effect_scene(const Effect& effect, Scene mesh) {
  const EffectScene& from = effect.scene;
  if (from.mesh.empty()) {
    light_rectangle(from, mesh);
    if (from.light_color) mesh.lights[0].color = *from.light_color;
    return mesh;
  }
  const float aspect = static_cast<float>(effect.width) / static_cast<float>(effect.height);
  auto complete = complete_scene(std::move(mesh), from.setup, aspect);
  if (complete && from.light_color) complete->lights[0].color = *from.light_color;
  if (complete || !complete.error().file.empty()) return complete;
  Diagnostic fault = complete.error();
  if (!is_generated_mesh(from.mesh)) fault.file = path_in(effect, from.mesh).string();
  return fault;
}

Scene rectangle_scene(const Scene& scene) {
  Scene rectangle = generated_mesh("plane:1").value();
  rectangle.cameras = scene.cameras;
  rectangle.lights = scene.lights;
  return rectangle;
}

Result<Texture> effect_texture(const Effect& effect, const EffectTexture& texture, const HardwareProfile& profile,
                               const EffectReaders& readers) {
  const std::string part = "texture " + effect_detail::in_quotes(texture.name);
  const TextureRecipe recipe = recipe_of(effect, texture);
  const auto make = [&] { return made_texture(recipe, profile, readers); };
  auto made = readers.kept ? readers.kept(recipe, make) : make();
  if (!made) return fault_in(part, made.error());
  return made;
}

namespace {

Status set_constants(const EffectConstants& constants, CombinerState& state) {
  for (std::size_t which = 0; which < 2; ++which) {
    if (!constants.global[which]) continue;
    (which == 0 ? state.constant0 : state.constant1) = *constants.global[which];
    for (std::size_t place = state.per_stage_constants ? kFinalConstants : 0; place <= kFinalConstants; ++place) {
      state.origin[place][which] = {};
    }
  }
  for (std::size_t i = 0; i < constants.of_combiner.size(); ++i) {
    const EffectConstants::Pair& own = constants.of_combiner[i];
    if (!own[0] && !own[1]) continue;
    if (static_cast<int>(i) >= state.num_general_combiners) {
      return Diagnostic{.message = "constants of general combiner " + std::to_string(i) + ", but the program has " +
                                   std::to_string(state.num_general_combiners) + "; they are counted from 0"};
    }
    if (!state.per_stage_constants) {
      state.per_stage_constants = true;
      for (GeneralCombiner& combiner : state.general) {
        combiner.constant0 = state.constant0;
        combiner.constant1 = state.constant1;
      }
    }
    for (std::size_t which = 0; which < 2; ++which) {
      if (!own[which]) continue;
      (which == 0 ? state.general[i].constant0 : state.general[i].constant1) = *own[which];
      state.origin[i][which] = {};
    }
  }
  return {};
}

}  // namespace

Result<EffectProgram> effect_program(const Effect& effect, const EffectPass& pass, const HardwareProfile& profile,
                                     const EffectReaders& readers, std::vector<std::string>& warnings) {
  const std::string part = "pass " + effect_detail::in_quotes(pass.name);
  const std::filesystem::path file = path_in(effect, pass.program);
  auto read = readers.program(file, profile);
  if (!read) return fault_in(part, read.error());
  if (Status set = set_constants(pass.constants, read->state); !set) return fault_in(part, set.error());
  auto program = compile(read->state, profile);
  if (!program) {
    Diagnostic fault = program.error();
    fault.file = file.string();
    return fault_in(part, fault);
  }
  for (const ConstantName name : unset_constants(*program)) {
    warnings.push_back(part + ": " + name_of_constant(name) + " is not set; 0 is assumed");
  }
  return EffectProgram{.combiners = std::move(*program), .texture_shader = read->texture_shader};
}

}  // namespace ninebit
