#include "src/playground/shadow_answer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/effect/generated_meshes.h"
#include "ninebit/frame/pictures.h"
#include "ninebit/frame/technique_settings.h"
#include "ninebit/shadow/index_cube.h"
#include "src/playground/drawing.h"

namespace ninebit::playground {
namespace {

constexpr double kFarthest = 1e6;
constexpr int kMaxShadowMap = 2048;

// The request, besides the profile.
struct RequestedShadow {
  std::string scene{};
  SceneSetup setup{};
  RenderSettings settings{};
};

std::optional<glm::vec3> asked_point(Request& request, const json::Value* value) {
  if (value == nullptr) return std::nullopt;
  glm::vec3 point(0.0F);
  bool good = value->type == json::Type::array && value->children.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const auto number = request.real_of(value->children[i], -kFarthest, kFarthest);
    good = number.has_value();
    if (good) point[static_cast<glm::length_t>(i)] = static_cast<float>(*number);
  }
  if (good) return point;
  request.reader().fault(value->offset, "a point is an array of three numbers from -1e6 to 1e6");
  return std::nullopt;
}

void read_shadow_camera(Request& request, SceneSetup& setup) {
  const json::Value* const camera = request.find("camera");
  if (camera == nullptr || !request.reader().object(*camera, {"position", "target", "fov"})) return;
  setup.camera = asked_point(request, json::Reader::find(*camera, "position"));
  setup.look_at = asked_point(request, json::Reader::find(*camera, "target"));
  if (const json::Value* const fov = json::Reader::find(*camera, "fov")) {
    const auto degrees = request.real_of(*fov, 0.01, 170.0);
    if (!degrees) request.reader().fault(fov->offset, "fov is a number of degrees from 0.01 to 170");
    if (degrees) setup.fov_degrees = static_cast<float>(*degrees);
  }
}

// The settings of techniques that the page may ask for, with their keys.
std::vector<std::pair<std::string, const TechniqueSetting*>> page_settings() {
  std::vector<std::pair<std::string, const TechniqueSetting*>> all;
  for (const TechniqueSetting& setting : technique_settings()) {
    if (setting.name == "index-scope" || setting.name == "section-size") continue;  // a browser cannot make sections
    if (setting.group->readers == kAllTechniques || !is_read(setting, "index-cube", {})) continue;
    const std::string key = setting.key();
    all.emplace_back(key.starts_with("index_") ? key.substr(6) : key, &setting);
  }
  return all;
}

void read_setting(Request& request, const std::string& key, const TechniqueSetting& setting, RenderSettings& settings) {
  const json::Value* const value = request.find(key);
  if (value == nullptr) return;
  std::optional<SettingValue> asked;
  if (setting.kind == SettingKind::word) {
    asked = setting.value_of(request.word(key));
  } else {
    const double most = setting.power_of_two ? kMaxShadowMap : setting.greatest;
    if (setting.kind == SettingKind::whole) {
      asked = SettingValue{
          static_cast<double>(request.number(key, static_cast<int>(setting.least), static_cast<int>(most)))};
    } else if (const auto number = request.real_of(*value, setting.least, most)) {
      asked = SettingValue{*number};
    }
  }
  if (request.failed()) return;
  if (asked && setting.allows(*asked)) return setting.set(settings, *asked);
  std::string expected(setting.expected);
  if (setting.power_of_two) expected = "a power of two from 1 to " + std::to_string(kMaxShadowMap);
  for (const SettingWord& word : setting.words) expected += (expected.empty() ? "" : " or ") + std::string(word.word);
  request.reader().fault(value->offset, key + " is not valid; expected " + expected);
}

RequestedShadow requested_shadow(Request& request) {
  RequestedShadow asked;
  asked.scene = request.word_or("scene", kRoomName);
  RenderSettings& settings = asked.settings;
  settings.width = 640;
  settings.height = 480;
  request.picture_size(settings.width, settings.height);
  for (const auto& [key, setting] : page_settings()) read_setting(request, key, *setting, settings);
  settings.cartoon = request.flag_or("cartoon", false);
  settings.light_facing = request.flag_or("light_facing", false);
  read_shadow_camera(request, asked.setup);
  asked.setup.light = asked_point(request, request.find("light"));
  return asked;
}

// Appends a picture of 1, 3 or 4 components as RGBA.
void append_image(const Image8& image, std::vector<std::uint8_t>& bytes) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t count = image.pixels.size() / channels;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) bytes.push_back(image.pixels[i * channels + std::min(c, channels - 1)]);
    bytes.push_back(channels == 4 ? image.pixels[i * channels + 3] : 255);
  }
}

Json facts_of(const Rendering& rendering) {
  Json facts = Json::object();
  for (const Fact& fact : rendering.facts) {
    std::visit([&](const auto& value) { facts[fact.name] = value; }, fact.value);
  }
  return facts;
}

Json order_of(const IndexOrderReport& report) {
  Json order{{"used", name_of(report.order)}};
  if (!report.reason.empty()) order["reason"] = report.reason;
  if (report.order == IndexOrder::file) return order;
  order["patches"] = report.patches;
  order["borders"] = report.borders;
  order["broken_borders"] = report.broken_borders;
  order["broken_share"] = report.broken_share;
  return order;
}

}  // namespace

Json view_of(const Scene& scene) {
  const auto list = [](const glm::vec3& v) { return Json{v.x, v.y, v.z}; };
  const Camera& camera = scene.cameras[0];
  return Json{{"position", list(camera.position)},
              {"target", list(camera.look_at)},
              {"fov", camera.vertical_fov_degrees},
              {"light", list(scene.lights[0].position)}};
}

std::optional<Reply> ask_for_shadow(Request& request, const Shelf& shelf, ShadowRequest& out) {
  const auto settings = page_settings();
  std::vector<std::string_view> keys{"scene", "profile", "camera", "light", "size", "cartoon", "light_facing", "hash"};
  for (const auto& [key, setting] : settings) keys.push_back(key);
  request.allow(keys);
  RequestedShadow asked = requested_shadow(request);
  out.profile = request.profile("profile");
  out.hashed = request.flag_or("hash", true);
  if (request.failed()) return request.refused();
  out.settings = asked.settings;
  out.settings.profile = out.profile.profile();
  const bool generated = is_generated_mesh(asked.scene);
  if (generated) {
    if (std::string complaint = complaint_about_mesh(asked.scene); !complaint.empty())
      return refusal(complaint, "request");
  }
  auto scene = generated ? generated_mesh(asked.scene) : shelf_scene(asked.scene, shelf, std::nullopt);
  if (!scene) return refusal(scene.error());
  const float aspect = static_cast<float>(out.settings.width) / static_cast<float>(out.settings.height);
  auto complete = complete_scene(std::move(*scene), asked.setup, aspect);
  if (!complete) return refusal(complete.error());
  out.scene = std::move(*complete);
  return std::nullopt;
}

Reply shadow_answer(Request& request, const Shelf& shelf, std::vector<std::uint8_t>& bytes) {
  ShadowRequest asked;
  if (auto refused = ask_for_shadow(request, shelf, asked)) return std::move(*refused);
  const auto rendering = render_index_cube(asked.scene, asked.settings, {});
  if (!rendering) return refusal(rendering.error());
  const Image8 picture = color_picture(*rendering), cross = index_cross_picture(*rendering);
  append_image(picture, bytes);
  append_image(cross, bytes);
  Json out{{"width", picture.width}, {"height", picture.height}};
  out["cube"] = {{"width", cross.width}, {"height", cross.height}};
  out["profile"] = asked.settings.profile.name;
  out["triangles"] = asked.scene.triangles.size();
  out["pixels"] = {{"background", rendering->background}, {"lit", rendering->lit}, {"shadowed", rendering->shadowed}};
  out["codes_used"] = rendering->codes_used;
  out["order"] = order_of(rendering->index_order);
  out["facts"] = facts_of(*rendering);
  out["view"] = view_of(asked.scene);
  if (asked.hashed) out["hash"] = hashes_of(rendering->frame);
  out["bytes"] = bytes.size();
  return out;
}

}  // namespace ninebit::playground
