#include <algorithm>
#include <set>

#include "src/effect/effect_words.h"

namespace ninebit {
namespace {

using effect_detail::in_quotes;
using effect_detail::is_color_source;
using effect_detail::is_coordinate_source;

bool is_power_of_two(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

bool reads_target(const EffectTexture& texture) {
  return texture.origin == TextureOrigin::target_color || texture.origin == TextureOrigin::target_depth;
}

// Collects the faults of one effect.
class Checker {
 public:
  explicit Checker(const Effect& effect) : effect_(effect) {}

  std::vector<EffectFault> check() {
    check_whole();
    for (std::size_t i = 0; i < effect_.targets.size(); ++i) check_target(i);
    for (std::size_t i = 0; i < effect_.textures.size(); ++i) check_texture(i);
    for (std::size_t i = 0; i < effect_.passes.size(); ++i) check_pass(i);
    if (faults_.empty() && drawn_.count(std::string(kPictureTarget)) == 0) {
      fault(EffectPart::whole, 0, "", "no pass draws the picture");
    }
    return std::move(faults_);
  }

 private:
  void fault(EffectPart part, std::size_t number, const std::string& name, const std::string& message) {
    const std::string kind = part == EffectPart::texture ? "texture" : part == EffectPart::target ? "target" : "pass";
    faults_.push_back(
        {part, number, part == EffectPart::whole ? message : kind + " " + in_quotes(name) + ": " + message});
  }

  [[nodiscard]] const EffectTarget* target_of(const std::string& name) const {
    const auto found = std::find_if(effect_.targets.begin(), effect_.targets.end(),
                                    [&](const EffectTarget& t) { return t.name == name; });
    return found == effect_.targets.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool is_target(const std::string& name) const {
    return name == kPictureTarget || target_of(name) != nullptr;
  }
  [[nodiscard]] const EffectTexture* texture_of(const std::string& name) const {
    const auto found = std::find_if(effect_.textures.begin(), effect_.textures.end(),
                                    [&](const EffectTexture& t) { return t.name == name; });
    return found == effect_.textures.end() ? nullptr : &*found;
  }
  // "; expected 'picture', 'map'" after an unknown name.
  [[nodiscard]] std::string known_targets() const {
    std::string list = "; expected " + in_quotes(kPictureTarget);
    for (const EffectTarget& target : effect_.targets) list += ", " + in_quotes(target.name);
    return list;
  }
  [[nodiscard]] std::string known_textures() const {
    if (effect_.textures.empty()) return "; the effect has no textures";
    std::string list;
    for (const EffectTexture& texture : effect_.textures)
      list += (list.empty() ? "; expected " : ", ") + in_quotes(texture.name);
    return list;
  }

  static bool size_is_valid(int width, int height) {
    return width >= 1 && height >= 1 && width <= kMaxSurfaceSize && height <= kMaxSurfaceSize;
  }

  void check_whole() {
    if (!size_is_valid(effect_.width, effect_.height)) {
      fault(EffectPart::whole, 0, "",
            "the picture's size " + std::to_string(effect_.width) + " x " + std::to_string(effect_.height) +
                " is out of range; expected 1 to " + std::to_string(kMaxSurfaceSize) + " a side");
    }
    if (effect_.passes.empty() || effect_.passes.size() > kMaxEffectPasses) {
      fault(EffectPart::whole, 0, "",
            "the effect has " + std::to_string(effect_.passes.size()) + " passes; expected 1 to " +
                std::to_string(kMaxEffectPasses));
    }
  }

  void check_target(std::size_t number) {
    const EffectTarget& target = effect_.targets[number];
    const auto complain = [&](const std::string& message) { fault(EffectPart::target, number, target.name, message); };
    if (target.name.empty()) complain("the name is empty");
    if (target.name == kPictureTarget) complain("is the name of the picture, which every effect has");
    if (target_of(target.name) != &target) complain("is defined twice");
    if (!size_is_valid(target.width, target.height)) {
      complain("size " + std::to_string(target.width) + " x " + std::to_string(target.height) +
               " is out of range; expected 1 to " + std::to_string(kMaxSurfaceSize) + " a side");
    }
    if (target.cube && target.width != target.height) complain("is a cube map, but its faces are not square");
    if (target.cube && target.samples != SampleMode::center_1) complain("is a cube map; expected one sample a pixel");
    const auto& formats = effect_detail::kTargetFormats;
    if (std::none_of(formats.begin(), formats.end(), [&](const auto& f) { return f.second == target.format; })) {
      complain("has a format that cannot be drawn; expected " + effect_detail::list_of(formats));
    }
  }

  void check_texture(std::size_t number) {
    const EffectTexture& texture = effect_.textures[number];
    const auto complain = [&](const std::string& message) {
      fault(EffectPart::texture, number, texture.name, message);
    };
    if (texture.name.empty()) complain("the name is empty");
    if (texture_of(texture.name) != &texture) complain("is defined twice");
    constexpr std::array<bool, 2> kStraight{};
    if (texture.sampler.cylinder_wrap != kStraight && cylinder_of(texture.sampler) == kStraight) {
      complain("a cylinder wrap has no effect with this wrap mode; expected repeat");
    }
    if (!reads_target(texture)) return;
    if (!is_target(texture.target))
      return complain("reads an unknown target " + in_quotes(texture.target) + known_targets());
    const EffectTarget* const target = target_of(texture.target);
    const int width = target == nullptr ? effect_.width : target->width * sample_columns(target->samples);
    const int height = target == nullptr ? effect_.height : target->height * sample_rows(target->samples);
    if (!is_power_of_two(width) || !is_power_of_two(height)) {
      complain("reads target " + in_quotes(texture.target) + " of " + std::to_string(width) + " x " +
               std::to_string(height) + "; expected powers of two");
    }
    if (texture.origin != TextureOrigin::target_depth) return;
    const DepthStencilFormat format = target == nullptr ? effect_.depth_stencil : target->depth_stencil;
    if (target != nullptr && target->cube) complain("reads the depth of a cube map, which GL does not have");
    if (format != DepthStencilFormat::d24s8 && format != DepthStencilFormat::d16) {
      complain("reads the depth of " + std::string(layout_of(format).name) + "; expected d24s8 or d16");
    }
  }

  void check_pass(std::size_t number) {
    const EffectPass& pass = effect_.passes[number];
    const auto complain = [&](const std::string& message) { fault(EffectPart::pass, number, pass.name, message); };
    const auto same_name = [&](const EffectPass& other) { return &other != &pass && other.name == pass.name; };
    if (std::any_of(effect_.passes.begin(), effect_.passes.begin() + static_cast<std::ptrdiff_t>(number), same_name)) {
      complain("is defined twice");
    }
    if (!is_target(pass.target))
      return complain("draws into an unknown target " + in_quotes(pass.target) + known_targets());
    const EffectTarget* const target = target_of(pass.target);
    const bool cube = target != nullptr && target->cube;
    const ColorFormatFacts& color = facts_of(target == nullptr ? effect_.color_format : target->color_format);
    if (pass.state.blend.enabled && !color.blends()) {
      complain("blends into target " + in_quotes(pass.target) + " of format " + std::string(color.name) +
               ", which the chip does not");
    }
    const bool mesh = pass.geometry == EffectGeometry::mesh;
    if (mesh && effect_.scene.mesh.empty()) complain("draws a mesh, but the effect has none");
    if (cube && !mesh) complain("draws a rectangle into a cube map; expected a mesh");
    check_colors(pass, mesh, complain);
    check_polygons(pass.state, complain);
    for (std::size_t i = 0; i < kEffectUnits; ++i) {
      // The program's file may have stages, which read the coordinates of units without a texture.
      const bool may_be_read = pass.state.texture_shader.enabled || !pass.program.empty();
      if (pass.units[i].texture.empty() && !may_be_read) continue;
      check_unit(pass, pass.units[i], cube,
                 [&](const std::string& message) { complain("unit " + std::to_string(i) + ": " + message); });
    }
    drawn_.insert(pass.target);
  }

  template <class Complain>
  static void check_colors(const EffectPass& pass, bool mesh, const Complain& complain) {
    for (const ColorSource* color : {&pass.primary, &pass.secondary}) {
      const char* const which = color == &pass.primary ? "primary" : "secondary";
      if (!is_color_source(color->source)) {
        complain(std::string(which) + ": " + std::string(name_of(color->source)) + " is not a source of colours");
      }
      if (color->source == VertexSource::index && (!mesh || color == &pass.secondary)) {
        complain(std::string(which) + ": index is only for the primary colour of a mesh");
      }
    }
  }

  // Settings that only one polygon mode reads.
  template <class Complain>
  static void check_polygons(const PipelineState& state, const Complain& complain) {
    const auto only = [&](bool is_set, PolygonMode mode, const char* what) {
      if (!is_set || state.front_mode == mode || state.back_mode == mode) return;
      complain(std::string(what) + " has no effect here; expected polygon mode " +
               std::string(effect_detail::word_of(effect_detail::kPolygonModes, mode)));
    };
    only(state.polygon_stipple.has_value(), PolygonMode::fill, "polygon stipple");
    only(state.polygon_smooth, PolygonMode::fill, "polygon smoothing");
    only(state.line_smooth, PolygonMode::line, "line smoothing");
    only(state.line_width != 1.0F, PolygonMode::line, "a line width");
    only(state.point_size != 1.0F, PolygonMode::point, "a point size");
  }

  template <class Complain>
  void check_unit(const EffectPass& pass, const EffectUnit& unit, bool cube, const Complain& complain) {
    if (!is_coordinate_source(unit.coordinates.source)) {
      complain(std::string(name_of(unit.coordinates.source)) + " is not a source of texture coordinates");
    }
    if (cube && unit.coordinates.source == VertexSource::screen) {
      complain("screen coordinates are not available in the faces of a cube map");
    }
    if (unit.coordinates.source == VertexSource::point_sprite) {
      const bool draws_points =
          pass.state.front_mode == PolygonMode::point || pass.state.back_mode == PolygonMode::point;
      if (!draws_points) complain("point-sprite coordinates need polygon mode point");
      if (unit.coordinates.matrix != glm::mat4(1.0F)) complain("point-sprite coordinates have no matrix");
    }
    if (unit.texture.empty()) return;
    const EffectTexture* const texture = texture_of(unit.texture);
    if (texture == nullptr) return complain("unknown texture " + in_quotes(unit.texture) + known_textures());
    if (!reads_target(*texture) || !is_target(texture->target)) return;
    if (texture->target == pass.target) {
      complain("reads target " + in_quotes(pass.target) + ", which this pass draws into");
    } else if (drawn_.count(texture->target) == 0) {
      complain("reads target " + in_quotes(texture->target) + ", which no earlier pass draws");
    }
  }

  const Effect& effect_;
  std::set<std::string> drawn_;  // the targets of the passes so far
  std::vector<EffectFault> faults_;
};

}  // namespace

std::vector<EffectFault> check_effect(const Effect& effect) {
  return Checker(effect).check();
}

}  // namespace ninebit
