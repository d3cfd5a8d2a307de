#include "src/scene/files/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ninebit {
namespace {

// The numbers are GL's.
MinFilter min_filter_of(std::uint64_t number) {
  switch (number) {
    case 9728:
      return MinFilter::nearest;
    case 9729:
      return MinFilter::linear;
    case 9984:
      return MinFilter::nearest_mipmap_nearest;
    case 9985:
      return MinFilter::linear_mipmap_nearest;
    case 9986:
      return MinFilter::nearest_mipmap_linear;
    default:
      return MinFilter::linear_mipmap_linear;
  }
}

Wrap wrap_of(std::uint64_t number) {
  if (number == 33071) return Wrap::clamp_to_edge;
  return number == 33648 ? Wrap::mirrored_repeat : Wrap::repeat;
}

// Without filters glTF leaves the choice: trilinear.
Sampler sampler_of(const JsonValue& sampler) {
  const auto number = [&](const char* name) { return index_of(item(sampler, name)).value_or(0); };
  return {.min_filter = min_filter_of(number("minFilter")),
          .mag_filter = number("magFilter") == 9728 ? MagFilter::nearest : MagFilter::linear,
          .wrap_s = wrap_of(number("wrapS")),
          .wrap_t = wrap_of(number("wrapT"))};
}

float fraction_or(const JsonValue& value, double fallback) {
  return std::clamp(static_cast<float>(number_or(value, fallback)), 0.0F, 1.0F);
}

}  // namespace

GltfMaterials::GltfMaterials(const JsonValue& root, GltfStorage& storage, Scene& scene)
    : root_(root),
      storage_(storage),
      scene_(scene),
      of_image_(list_of(item(root, "images")).size()),
      left_(storage.bytes()) {}

void GltfMaterials::add(const JsonValue& from) {
  Material out{.name = text_of(item(from, "name")), .base_color = glm::vec3(1.0F)};
  const JsonValue& factor = item(from, "pbrMetallicRoughness", "baseColorFactor");
  if (list_of(factor).size() == 4) {
    for (glm::length_t i = 0; i < 3; ++i) {
      out.base_color[i] = fraction_or(item(factor, static_cast<std::uint64_t>(i)), 1.0);
    }
    out.alpha = fraction_or(item(factor, 3), 1.0);
  }
  const std::string& mode = text_of(item(from, "alphaMode"));
  if (mode == "MASK") out.alpha_mode = AlphaMode::mask;
  if (mode == "BLEND") out.alpha_mode = AlphaMode::blend;
  const float cutoff = static_cast<float>(number_or(item(from, "alphaCutoff"), 0.5));
  out.alpha_cutoff = std::clamp(cutoff, 0.0F, 2.0F);  // above 1 nothing is drawn
  add_texture(item(from, "pbrMetallicRoughness", "baseColorTexture"), out);
  scene_.materials.push_back(std::move(out));
}

void GltfMaterials::add_texture(const JsonValue& info, Material& out) {
  if (info.is_null() || index_of(item(info, "texCoord")).value_or(0) != 0) return;
  const JsonValue& texture = target_of(item(root_, "textures"), item(info, "index"));
  const std::optional<std::uint64_t> image = index_of(item(texture, "source"));
  if (!image || *image >= of_image_.size()) {
    out.base_texture = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back({.name = fmt::format("textures[{}]", index_of(item(info, "index")).value_or(0)),
                               .fault = "names a picture that does not exist"});
    return;
  }
  out.base_texture = texture_of(*image);
  out.sampler = sampler_of(target_of(item(root_, "samplers"), item(texture, "sampler")));
}

std::uint32_t GltfMaterials::texture_of(std::uint64_t number) {
  std::optional<std::uint32_t>& known = of_image_[number];
  if (!known) {
    known = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(read_image(item(root_, "images", number), number));
  }
  return *known;
}

SceneTexture GltfMaterials::read_image(const JsonValue& image, std::uint64_t number) {
  SceneTexture out{.name = fmt::format("images[{}]", number)};
  const std::string& uri = text_of(item(image, "uri"));
  if (uri.empty()) {
    const JsonValue& view = target_of(item(root_, "bufferViews"), item(image, "bufferView"));
    if (view.is_null()) {
      out.fault = "has neither a URI nor a buffer view";
      return out;
    }
    const Result<std::string_view> bytes = storage_.view_bytes(view);
    if (!bytes) {
      out.fault = bytes.error().message;
    } else if (bytes->empty()) {
      out.fault = "is empty";
    } else if (bytes->size() > left_) {
      out.fault = "overlaps other pictures: together they have more bytes than the file's buffers";
    } else {
      left_ -= bytes->size();
      out.bytes = *bytes;
    }
    return out;
  }
  if (!uri.starts_with("data:")) {
    storage_.name_file(decode_percent(uri), out);
    return out;
  }
  const std::size_t data = uri.find(";base64,");
  std::optional<std::string> bytes;
  if (data != std::string::npos) bytes = decode_base64(std::string_view(uri).substr(data + 8));
  if (bytes && !bytes->empty()) {
    out.bytes = std::move(*bytes);
  } else {
    out.fault = "is not in base64, or is empty";
  }
  return out;
}

}  // namespace ninebit
