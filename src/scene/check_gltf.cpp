#include <fmt/format.h>

#include <cstring>
#include <system_error>

#include "src/scene/fault_of.h"
#include "src/scene/file_check.h"
#include "src/scene/gltf_geometry.h"
#include "src/scene/gltf_nodes.h"
#include "src/scene/json_value.h"

namespace ninebit {
namespace {

std::string numbered(const char* what, std::size_t number) {
  return fmt::format("{} {}", what, number);
}

std::uint64_t little32(std::string_view data, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(data[at + i]);
  return value;
}

// The parts of a .glb file: a header of 12 bytes, then chunks, each with its length and type before it.
struct GlbParts {
  std::string_view json;
  std::optional<std::string_view> binary;
};

Result<GlbParts> split_glb(std::string_view content) {
  constexpr std::uint64_t kJson = 0x4E4F534A;
  constexpr std::uint64_t kBinary = 0x004E4942;
  if (content.substr(0, 4) != "glTF") return fault_of("is not a binary glTF file: it does not start with 'glTF'");
  if (content.size() < 20) return fault_of("ends early, within its header");
  if (little32(content, 4) != 2)
    return fault_of(fmt::format("is of binary glTF version {}; version 2 is read", little32(content, 4)));
  const std::uint64_t length = little32(content, 8);
  if (length > content.size())
    return fault_of(fmt::format("ends early: it declares {} bytes and has {}", length, content.size()));
  GlbParts parts;
  std::string_view rest = content.substr(12, length < 12 ? 0 : length - 12);
  for (bool first = true; rest.size() >= 8; first = false) {
    const std::uint64_t size = little32(rest, 0);
    const std::uint64_t type = little32(rest, 4);
    if (size > rest.size() - 8) return fault_of("is malformed: a chunk is longer than the file");
    if (first && type != kJson) return fault_of("is malformed: its first chunk is not JSON");
    if (first) parts.json = rest.substr(8, size);
    if (!first && type == kBinary && !parts.binary) parts.binary = rest.substr(8, size);
    rest.remove_prefix(8 + size);
  }
  return parts;
}

void append_little32(std::string& out, std::size_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>((value >> shift) & 255U));
}

std::string join_glb(std::string json, std::optional<std::string_view> binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t binary_size = binary ? binary->size() : 0;
  const std::size_t padding = (4 - binary_size % 4) % 4;
  std::string out = "glTF";
  append_little32(out, 2);
  append_little32(out, 20 + json.size() + (binary ? 8 + binary_size + padding : 0));
  append_little32(out, json.size());
  out.append("JSON").append(json);
  if (binary) {
    append_little32(out, binary_size + padding);
    out.append("BIN").push_back('\0');
    out.append(*binary).append(padding, '\0');
  }
  return out;
}

// How many bytes a base64 text of this length holds, '=' padding taken off.
std::uint64_t base64_size(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  return text.size() * 3 / 4;
}

std::optional<Diagnostic> check_buffer(const Json& buffer, std::size_t number, const std::filesystem::path& folder,
                                       const std::optional<std::uint64_t>& binary_size) {
  const std::optional<std::uint64_t> declared = index_of(item(buffer, "byteLength"));
  if (!declared) return fault_of(fmt::format("{} has no length", numbered("buffer", number)));
  if (*declared > kMostSceneBytes)
    return fault_of(fmt::format("{} declares {} bytes; at most {} are read", numbered("buffer", number), *declared,
                                kMostSceneBytes));
  const std::string& uri = text_of(item(buffer, "uri"));
  std::uint64_t present = 0;
  if (uri.empty()) {
    if (number != 0 || !binary_size)
      return fault_of(fmt::format("{} has neither a URI nor a chunk", numbered("buffer", number)));
    present = *binary_size;
  } else if (uri.starts_with("data:")) {
    const std::size_t data = uri.find(";base64,");
    if (data == std::string::npos) return fault_of(fmt::format("{} is not in base64", numbered("buffer", number)));
    if (uri.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=", data + 8) !=
        std::string::npos)
      return fault_of(fmt::format("{} holds characters that are not base64", numbered("buffer", number)));
    present = base64_size(std::string_view(uri).substr(data + 8));
  } else {
    if (uri.find('%') != std::string::npos) return std::nullopt;  // Assimp decodes these
    std::error_code error;
    present = std::filesystem::file_size(folder / uri, error);
    if (error) return fault_of(fmt::format("its buffer file '{}' cannot be opened: {}", uri, error.message()));
  }
  if (present < *declared)
    return fault_of(
        fmt::format("{} ends early: it declares {} bytes and has {}", numbered("buffer", number), *declared, present));
  return std::nullopt;
}

std::uint64_t component_size(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::uint64_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

// 0 where a part states no offset, and past every end where it states one that is no index.
std::uint64_t offset_of(const Json& part) {
  const Json& offset = item(part, "byteOffset");
  return offset.is_null() ? 0 : index_of(offset).value_or(1ULL << 53U);
}

std::optional<Diagnostic> check_accessor(const Json& root, const Json& accessor, std::size_t number) {
  const std::string name = numbered("accessor", number);
  const std::uint64_t size = component_size(index_of(item(accessor, "componentType")).value_or(0));
  const std::uint64_t element = size * component_count(text_of(item(accessor, "type")));
  const std::optional<std::uint64_t> count = index_of(item(accessor, "count"));
  if (element == 0 || !count || *count == 0) return fault_of(fmt::format("{} has no valid type or count", name));
  // Assimp would write where a sparse accessor's own indices point, unchecked.
  if (!item(accessor, "sparse").is_null())
    return fault_of(fmt::format("{} is sparse; such accessors are not read", name));
  if (item(accessor, "bufferView").is_null()) return std::nullopt;
  const Json& view = target_of(item(root, "bufferViews"), item(accessor, "bufferView"));
  if (view.is_null()) return fault_of(fmt::format("{} names a buffer view that is not there", name));
  const std::uint64_t stride = index_of(item(view, "byteStride")).value_or(element);
  const std::uint64_t offset = offset_of(accessor);
  const std::uint64_t length = index_of(item(view, "byteLength")).value_or(0);
  if (stride > 252 || *count > length || offset + (*count - 1) * stride + element > length)
    return fault_of(fmt::format("{} reaches past the end of its buffer view", name));
  return std::nullopt;
}

std::optional<Diagnostic> check_view(const Json& root, const Json& view, std::size_t number) {
  const Json& buffer = target_of(item(root, "buffers"), item(view, "buffer"));
  const std::optional<std::uint64_t> length = index_of(item(view, "byteLength"));
  if (buffer.is_null() || !length)
    return fault_of(fmt::format("{} has no buffer or no length", numbered("buffer view", number)));
  if (offset_of(view) + *length > index_of(item(buffer, "byteLength")).value_or(0))
    return fault_of(fmt::format("{} reaches past the end of its buffer", numbered("buffer view", number)));
  return std::nullopt;
}

std::optional<Diagnostic> check_storage(const Json& root, const std::filesystem::path& folder,
                                        const std::optional<std::uint64_t>& binary_size) {
  const Json& buffers = list_of(item(root, "buffers"));
  const Json& views = list_of(item(root, "bufferViews"));
  const Json& accessors = list_of(item(root, "accessors"));
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (auto fault = check_buffer(buffers[i], i, folder, binary_size)) return fault;
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (auto fault = check_view(root, views[i], i)) return fault;
  }
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    if (auto fault = check_accessor(root, accessors[i], i)) return fault;
  }
  return std::nullopt;
}

}  // namespace

Result<FileFacts> check_gltf(std::string_view content, const std::filesystem::path& file, bool binary) {
  GlbParts parts{content, std::nullopt};
  if (binary) {
    Result<GlbParts> split = split_glb(content);
    if (!split) return split.error();
    parts = *split;
  }
  Result<Json> root = parse_json(parts.json);
  if (!root) return root.error();
  const std::string& version = text_of(item(*root, "asset", "version"));
  if (version.empty()) return fault_of("is not a glTF file: it states no version of its format");
  if (!version.starts_with("2.")) return fault_of(fmt::format("is of glTF version {}; version 2.0 is read", version));
  const std::optional<std::uint64_t> binary_size =
      parts.binary ? std::optional<std::uint64_t>(parts.binary->size()) : std::nullopt;
  if (auto fault = check_storage(*root, file.parent_path(), binary_size)) return *fault;
  Result<FileFacts> facts = read_gltf_nodes(*root);
  if (facts) {
    std::string json = gltf_geometry(*root);
    if (binary) json = join_glb(std::move(json), parts.binary);
    facts->for_assimp = std::move(json);
  }
  return facts;
}

}  // namespace ninebit
