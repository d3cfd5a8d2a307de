#include "ninebit/effect/effect_json.h"

#include <algorithm>

#include "ninebit/effect/generated_meshes.h"
#include "src/effect/effect_reader.h"

namespace ninebit {
namespace {

using effect_detail::EffectReader;
using json::Type;
using json::Value;

// The places of an effect's parts in its text.
struct PartPlaces {
  std::vector<std::size_t> textures{}, targets{}, passes{};
};

void read_scene_setup(EffectReader& read, const Value& value, EffectScene& scene) {
  if (!read.reader().object(value, {"mesh", "up", "camera", "look_at", "fov", "light", "light_type", "light_target",
                                    "spot_angle", "light_color", "floor"})) {
    return;
  }
  SceneSetup& setup = scene.setup;
  setup.floor = FloorChoice::none;
  const auto real = [&](std::string_view key, double lowest, double highest, std::optional<float>& into) {
    read.with(value, key,
              [&](const Value& v) { read.real(v, lowest, highest, into.emplace(), effect_detail::Numbers::moving); });
  };
  read.with(value, "mesh", [&](const Value& v) {
    read.text(v, scene.mesh);
    if (!is_generated_mesh(scene.mesh)) read.check_file(v, scene.mesh);
  });
  if (scene.mesh.empty())
    read.reader().fault(value.offset, "the key \"mesh\" is missing; expected a scene file or a generated mesh");
  read.with(value, "up", [&](const Value& v) { read.word(v, effect_detail::kUpAxes, "axis", scene.up.emplace()); });
  read.with(value, "camera", [&](const Value& v) { read.point(v, setup.camera); });
  read.with(value, "look_at", [&](const Value& v) { read.point(v, setup.look_at); });
  real("fov", 0.01, 170.0, setup.fov_degrees);
  read.with(value, "light", [&](const Value& v) { read.point(v, setup.light); });
  read.with(value, "light_type", [&](const Value& v) {
    LightKind kind = LightKind::point;
    read.word(v, effect_detail::kLightKinds, "kind of light", kind);
    setup.light_kinds = {.point = kind == LightKind::point,
                         .spot = kind == LightKind::spot,
                         .directional = kind == LightKind::directional};
  });
  read.with(value, "light_target", [&](const Value& v) { read.point(v, setup.light_target); });
  real("spot_angle", 1.0, 170.0, setup.spot_degrees);
  read.with(value, "light_color", [&](const Value& v) {
    std::array<float, 3> n{};
    if (read.reals(v, 3, 0.0, 1.0, n, effect_detail::Numbers::moving) != 0)
      scene.light_color = glm::vec3(n[0], n[1], n[2]);
  });
  read.with(value, "floor", [&](const Value& v) {
    if (v.type == Type::string && v.text == "none") return;
    if (v.type == Type::string && v.text == "auto") {
      setup.floor = FloorChoice::automatic;
    } else if (v.type == Type::number) {
      setup.floor = FloorChoice::at_height;
      read.real(v, -1e12, 1e12, setup.floor_height);
    } else {
      read.reader().fault(v.offset, "floor must be \"auto\", \"none\" or a height");
    }
  });
}

EffectTexture read_effect_texture(EffectReader& read, const Value& value) {
  EffectTexture texture;
  if (!read.reader().object(value, {"source", "steepness", "filter", "wrap", "border_color", "border_texels",
                                    "cylinder_wrap", "color_key", "compare", "lod_bias"}))
    return texture;
  if (json::Reader::find(value, "source") == nullptr) {
    read.reader().fault(value.offset, "the key \"source\" is missing; expected a file or a generated texture");
  }
  read.with(value, "source", [&](const Value& v) {
    read.parsed(v, &parse_texture_source, texture);
    for (const std::string& file : texture.files) read.check_file(v, file);
  });
  read.with(value, "steepness", [&](const Value& v) {
    if (!effect_detail::has_slopes(texture.origin)) {
      read.reader().fault(v.key_offset,
                          "steepness is only for normals:FILE, signed-normals:FILE, hilo-normals:FILE and "
                          "offsets:FILE");
    }
    read.real(v, 1e-3, 1e3, texture.steepness);
  });
  for (const effect_detail::SamplerWord& word : effect_detail::kSamplerWords) {
    read.with(value, word.key, [&](const Value& v) {
      if (v.type != Type::string) return read.reader().wrong_type(v, "a string");
      if (Status done = word.parse(v.text, texture.sampler); !done) read.reader().fault(v.offset, done.error().message);
    });
  }
  read.with(value, "border_color", [&](const Value& v) { read.reals(v, 4, 0.0, 1.0, texture.sampler.border_color); });
  read.with(value, "border_texels", [&](const Value& v) { read.reader().boolean(v, texture.sampler.border_texels); });
  read.with(value, "compare", [&](const Value& v) {
    if (texture.origin != TextureOrigin::target_depth)
      read.reader().fault(v.key_offset, "compare is only for depth:NAME");
    read.word(v, effect_detail::kDepthComparisons, "depth comparison", texture.sampler.comparison);
  });
  read.with(value, "lod_bias", [&](const Value& v) { read.real(v, -15.0, 15.0, texture.sampler.lod_bias); });
  return texture;
}

// "size": [width, height], or one number for both.
void read_size(EffectReader& read, const Value& value, int& width, int& height) {
  if (value.type == Type::number) {
    read.reader().integer(value, 1, kMaxSurfaceSize, width);
    height = width;
    return;
  }
  if (value.type != Type::array || value.children.size() != 2) {
    return read.reader().fault(value.offset, "size must be a number or an array of width and height");
  }
  read.reader().integer(value.children[0], 1, kMaxSurfaceSize, width);
  read.reader().integer(value.children[1], 1, kMaxSurfaceSize, height);
}

EffectTarget read_effect_target(EffectReader& read, const Value& value) {
  EffectTarget target;
  if (!read.reader().object(value, {"size", "cube", "format", "color_format", "depth_stencil", "samples"}))
    return target;
  if (json::Reader::find(value, "size") == nullptr) read.reader().fault(value.offset, "the key \"size\" is missing");
  read.with(value, "size", [&](const Value& v) { read_size(read, v, target.width, target.height); });
  read.with(value, "cube", [&](const Value& v) { read.reader().boolean(v, target.cube); });
  read.with(value, "format",
            [&](const Value& v) { read.word(v, effect_detail::kTargetFormats, "format", target.format); });
  read.with(value, "color_format", [&](const Value& v) {
    read.word(v, effect_detail::kColorFormatWords, "colour format", target.color_format);
  });
  read.with(value, "depth_stencil", [&](const Value& v) {
    read.word(v, effect_detail::kDepthStencilFormats, "depth-stencil format", target.depth_stencil);
  });
  read.with(value, "samples",
            [&](const Value& v) { read.word(v, effect_detail::kSampleModes, "sample mode", target.samples); });
  return target;
}

// The members of an object, each read by `read_one` and named by its key.
template <class T, class ReadOne>
void read_named(EffectReader& read, const Value& value, std::vector<T>& into, std::vector<std::size_t>& places,
                const ReadOne& read_one) {
  if (value.type != Type::object) return read.reader().wrong_type(value, "an object");
  for (const Value& child : value.children) {
    into.push_back(read_one(read, child));
    into.back().name = child.key;
    places.push_back(child.key_offset);
  }
}

Effect read_root(EffectReader& read, const Value& root, PartPlaces& places) {
  Effect effect;
  if (!read.reader().object(root, {"ninebit", "version", "title", "note", "profile", "size", "color_format",
                                   "depth_stencil", "scene", "textures", "targets", "passes"})) {
    return effect;
  }
  read.with(root, "title", [&](const Value& v) { read.text(v, effect.title); });
  read.with(root, "note", [&](const Value& v) { read.text(v, effect.note); });
  read.with(root, "profile", [&](const Value& v) { read.text(v, effect.profile); });
  read.with(root, "size", [&](const Value& v) { read_size(read, v, effect.width, effect.height); });
  read.with(root, "color_format", [&](const Value& v) {
    read.word(v, effect_detail::kColorFormatWords, "colour format", effect.color_format);
  });
  read.with(root, "depth_stencil", [&](const Value& v) {
    read.word(v, effect_detail::kDepthStencilFormats, "depth-stencil format", effect.depth_stencil);
  });
  read.with(root, "scene", [&](const Value& v) { read_scene_setup(read, v, effect.scene); });
  read.with(root, "textures",
            [&](const Value& v) { read_named(read, v, effect.textures, places.textures, &read_effect_texture); });
  read.with(root, "targets",
            [&](const Value& v) { read_named(read, v, effect.targets, places.targets, &read_effect_target); });
  read.with(root, "passes", [&](const Value& v) {
    if (v.type != Type::array) return read.reader().wrong_type(v, "an array");
    for (const Value& child : v.children) {
      effect.passes.push_back(effect_detail::read_pass(read, child, effect));
      if (effect.passes.back().name.empty()) effect.passes.back().name = "pass " + std::to_string(effect.passes.size());
      places.passes.push_back(child.offset);
    }
  });
  return effect;
}

std::size_t place_of_fault(const EffectFault& fault, const Value& root, const PartPlaces& places) {
  switch (fault.part) {
    case EffectPart::texture:
      return places.textures[fault.number];
    case EffectPart::target:
      return places.targets[fault.number];
    case EffectPart::pass:
      return places.passes[fault.number];
    case EffectPart::whole:
      break;
  }
  return root.offset;
}

}  // namespace

Parsed<Effect> parse_effect(const SourceText& source, const EffectMoment& moment) {
  return effect_detail::parse_effect(source, {}, moment);
}

Parsed<Effect> effect_detail::parse_effect(const SourceText& source, const NameCheck& check,
                                           const EffectMoment& moment) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const std::optional<Value> root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  json::Reader reader(source.text, faults);
  EffectReader read(reader, check, moment);
  PartPlaces places;
  if (root->type == Type::object) reader.heading(*root, "effect", true);
  // Another kind of file has no more to say.
  Effect effect = faults.empty() ? read_root(read, *root, places) : Effect{};
  if (faults.empty()) {
    for (const EffectFault& fault : check_effect(effect)) {
      reader.fault(place_of_fault(fault, *root, places), fault.message);
    }
  }
  if (!faults.empty()) return faults.take();
  effect.moves = read.moves();
  return effect;
}

}  // namespace ninebit
