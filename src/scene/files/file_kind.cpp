#include "src/scene/files/file_kind.h"

#include <algorithm>
#include <array>

namespace ninebit {
namespace {

struct Signature {
  std::string_view start;
  std::string_view kind;
  std::string_view extension;  // of such files; empty: they are not scenes
};

using namespace std::string_view_literals;

constexpr std::array kSignatures{
    Signature{"\x89PNG"sv, "a PNG picture", ""},
    Signature{"\xFF\xD8\xFF"sv, "a JPEG picture", ""},
    Signature{"GIF8"sv, "a GIF picture", ""},
    Signature{"DDS "sv, "a DDS picture", ""},
    Signature{"\x76\x2F\x31\x01"sv, "an OpenEXR picture", ""},
    Signature{"II*\0"sv, "a TIFF picture", ""},
    Signature{"MM\0*"sv, "a TIFF picture", ""},
    Signature{"%PDF"sv, "a PDF document", ""},
    Signature{"PK\x03\x04"sv, "a ZIP archive", ""},
    Signature{"\x1F\x8B"sv, "a gzip archive", ""},
    Signature{"\x7F"
              "ELF"sv,
              "a program", ""},
    Signature{"!!RC1.0"sv, "a combiner program in RC1.0", ""},
    Signature{"<?xml"sv, "an XML file", ".dae"},
    Signature{"<!DOCTYPE"sv, "an HTML file", ""},
    Signature{"<html"sv, "an HTML file", ""},
    Signature{"Kaydara FBX"sv, "an FBX file", ".fbx"},
    Signature{"glTF"sv, "a binary glTF file (.glb)", ".glb"},
    Signature{"ply\n"sv, "a PLY file", ".ply"},
    Signature{"ply\r"sv, "a PLY file", ".ply"},
    Signature{"OFF\n"sv, "an OFF file", ".off"},
    Signature{"OFF\r"sv, "an OFF file", ".off"},
    Signature{"MM"sv, "a 3DS file", ".3ds"},
};

// The first byte of a text that is not blank.
char first_letter(std::string_view text) {
  const std::size_t at = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return at == std::string_view::npos ? '\0' : text[at];
}

}  // namespace

std::optional<std::string_view> other_kind(std::string_view content, std::string_view expected) {
  const auto* found = std::find_if(kSignatures.begin(), kSignatures.end(),
                                   [&](const Signature& one) { return content.starts_with(one.start); });
  if (found != kSignatures.end()) return found->extension == expected ? std::nullopt : std::optional(found->kind);
  if (first_letter(content) != '{' || expected == ".gltf") return std::nullopt;
  const std::string_view head = content.substr(0, 1U << 16U);
  return head.find("\"asset\"") != std::string_view::npos ? "a glTF file (.gltf)"sv : "a JSON file"sv;
}

void turn_up(UpAxis up, Scene& scene) {
  const float sign = up == UpAxis::z ? 1.0F : -1.0F;
  // Sums with 0 turn -0 into 0, as the readers do.
  const auto turn = [&](glm::vec3& v) { v = glm::vec3(v.x, sign * v.z, -sign * v.y) + 0.0F; };
  for (glm::vec3& v : scene.positions) turn(v);
  for (glm::vec3& v : scene.normals) turn(v);
  for (glm::vec4& t : scene.tangents) {
    glm::vec3 v(t);
    turn(v);
    t = glm::vec4(v, t.w);
  }
  for (Camera& camera : scene.cameras) {
    turn(camera.position);
    turn(camera.look_at);
    turn(camera.up);
  }
  for (Light& light : scene.lights) {
    turn(light.position);
    turn(light.direction);
  }
}

}  // namespace ninebit
